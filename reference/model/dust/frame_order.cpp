#include "reference/model/dust/frame_order.hpp"

namespace lockstep::dust {

std::vector<Kernel> frame_order(const Host& host) {
    std::vector<Kernel> all{{"populate"}};
    for (std::size_t ball = 0; ball < host.most_explosions(); ++ball)
        all.push_back({"explode", ball});
    const bool update_first = host.switches().kernel_order == KernelOrder::update_first;
    if (update_first && host.has_update())
        all.push_back({"update"});
    if (host.has(Tool::Kind::vacuum) && host.has_vacuum_kernel())
        all.push_back({"vacuum_up"});
    if (host.has(Tool::Kind::emit))
        all.push_back({"emit"});
    if (host.has(Tool::Kind::wind))
        all.push_back({"blow_wind"});
    if (!update_first && host.has_update())
        all.push_back({"update"});
    return all;
}

bool runs(const Host& host, const Kernel& kernel, int frame) {
    if (kernel.name == "populate")
        return frame == 0;
    if (kernel.name == "explode")
        return host.explosion(frame, kernel.ball) != nullptr;
    if (kernel.name == "vacuum_up")
        return host.is_on(Tool::Kind::vacuum, frame);
    if (kernel.name == "emit")
        return host.is_on(Tool::Kind::emit, frame);
    if (kernel.name == "blow_wind")
        return host.is_on(Tool::Kind::wind, frame);
    return true;
}

} // namespace lockstep::dust
