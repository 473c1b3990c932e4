#include "reference/dust/passes.hpp"
#include "reference/dust/update_twin.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> update_pass(const HostPtr& host) {
    std::vector<std::uint8_t> kept{field::colour.field};
    if (!host->update_may_kill())
        kept.push_back(field::alive.field);
    ItemPassOptions options{.name = "update",
                            .resource = grain_buffer,
                            .stage = PassStage::compute,
                            .arithmetic = host->settings().arithmetic,
                            .runs = [host](int frame) { return runs(*host, {"update"}, frame); },
                            .in_place = from_any_state,
                            .keeps = std::move(kept)};
    return item_pass(std::move(options), UpdateTwin{host});
}

} // namespace lockstep::dust
