#include "reference/dust/emit_twin.hpp"
#include "reference/dust/passes.hpp"
#include "reference/dust/tools_fast.hpp"
#include "reference/model/dust/frame_order.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> emit_pass(const HostPtr& host) {
    return item_pass(
        {.name = "emit",
         .resource = grain_buffer,
         .stage = PassStage::compute,
         .arithmetic = host->settings().arithmetic,
         .runs = [host](int frame) { return runs(*host, {"emit"}, frame); },
         .in_place = from_any_state,
         .keeps = {field::colour.field},
         .fast = [host](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                        const WritableView& after,
                        std::vector<std::size_t>& left) { emit_fast(*host, in, first, last, after, left); }},
        EmitTwin{host});
}

} // namespace lockstep::dust
