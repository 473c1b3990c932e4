#include "reference/dust/passes.hpp"
#include "reference/dust/vacuum_up_twin.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> vacuum_up_pass(const HostPtr& host) {
    const FieldId kept = host->switches().suction == Suction::force_kernel ? field::position : field::velocity;
    return item_pass({.name = "vacuum_up",
                      .resource = grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic,
                      .runs = [host](int frame) { return runs(*host, {"vacuum_up"}, frame); },
                      .in_place = from_any_state,
                      .keeps = {kept.field, field::colour.field}},
                     VacuumUpTwin{host});
}

} // namespace lockstep::dust
