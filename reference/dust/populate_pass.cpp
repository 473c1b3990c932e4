#include "reference/dust/passes.hpp"
#include "reference/dust/populate_twin.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> populate_pass(const HostPtr& host) {
    return item_pass({.name = "populate",
                      .resource = grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic,
                      .runs = [host](int frame) { return runs(*host, {"populate"}, frame); },
                      .in_place = from_any_state},
                     PopulateTwin{host});
}

} // namespace lockstep::dust
