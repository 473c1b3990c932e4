#include "reference/dust/explode_twin.hpp"
#include "reference/dust/passes.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> explode_pass(const HostPtr& host, std::size_t ball) {
    return item_pass({.name = "explode",
                      .resource = grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic,
                      .runs =
                          [host, ball](int frame) {
                              return runs(*host, {"explode", ball}, frame);
                          },
                      .in_place = from_any_state,
                      .keeps = {field::position.field, field::colour.field, field::alive.field}},
                     ExplodeTwin{host, ball});
}

} // namespace lockstep::dust
