#include "reference/dust/passes.hpp"

#include "reference/model/dust/frame_order.hpp"

namespace lockstep::dust {

std::vector<std::unique_ptr<ItemPass>> twins(const HostPtr& host) {
    std::vector<std::unique_ptr<ItemPass>> all;
    for (const Kernel& kernel : frame_order(*host)) {
        if (kernel.name == "populate")
            all.push_back(populate_pass(host));
        else if (kernel.name == "explode")
            all.push_back(explode_pass(host, kernel.ball));
        else if (kernel.name == "vacuum_up")
            all.push_back(vacuum_up_pass(host));
        else if (kernel.name == "emit")
            all.push_back(emit_pass(host));
        else if (kernel.name == "blow_wind")
            all.push_back(blow_wind_pass(host));
        else
            all.push_back(update_pass(host));
        const ItemPass& made = *all.back();
        all.push_back(count_pass(made));
    }
    return all;
}

} // namespace lockstep::dust
