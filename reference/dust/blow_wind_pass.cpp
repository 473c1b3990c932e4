#include "reference/dust/blow_wind_twin.hpp"
#include "reference/dust/passes.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> blow_wind_pass(const HostPtr& host) {
    return item_pass({.name = "blow_wind",
                      .resource = grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic,
                      .runs = [host](int frame) { return runs(*host, {"blow_wind"}, frame); },
                      .in_place = from_any_state,
                      .keeps = {field::position.field, field::colour.field, field::alive.field}},
                     BlowWindTwin{host});
}

} // namespace lockstep::dust
