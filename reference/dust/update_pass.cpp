#include "reference/dust/passes.hpp"
#include "reference/dust/update_fast.hpp"
#include "reference/dust/update_twin.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> update_pass(const HostPtr& host) {
    ItemPassOptions options{.name = "update",
                            .resource = grain_buffer,
                            .stage = PassStage::compute,
                            .arithmetic = host->settings().arithmetic,
                            .runs = [host](int frame) { return runs(*host, {"update"}, frame); },
                            .in_place = true};
    if (has_update_fast(*host))
        options.fast = [host](const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
                              const WritableView& after, std::vector<std::size_t>& left) {
            update_fast(*host, in, profile, first, last, after, left);
        };
    return item_pass(std::move(options), UpdateTwin{host});
}

} // namespace lockstep::dust
