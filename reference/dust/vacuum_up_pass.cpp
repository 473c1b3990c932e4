#include "reference/dust/passes.hpp"
#include "reference/dust/tools_fast.hpp"
#include "reference/dust/vacuum_up_twin.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> vacuum_up_pass(const HostPtr& host) {
    return item_pass({.name = "vacuum_up",
                      .resource = grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic,
                      .runs = [host](int frame) { return runs(*host, {"vacuum_up"}, frame); },
                      .in_place = true,
                      .fast =
                          [host](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                 const WritableView& after, std::vector<std::size_t>& left) {
                              reach_fast(*host, vacuum_reach(*host, in.frame), in, first, last, after, left);
                          }},
                     VacuumUpTwin{host});
}

} // namespace lockstep::dust
