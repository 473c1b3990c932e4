#include "reference/lifecycle/move_twin.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_move(Passes& all, const HostPtr& host, const HostEmitter& of) {
    const bool counts = host->switches().fuse == Fuse::fused && counts_in_simulation(*host, of);
    if (counts)
        all.push_back(item_pass(options_of(host, "move", counter_buffer), SimulatedCountTwin{frame_of(host, of, 0)}));
    all.push_back(item_pass(options_of(host, counts ? "move_particles" : "move", particle_buffer, counts),
                            MoveTwin{frame_of(host, of, 0)}));
}

void add_simulate(Passes& all, const HostPtr& host, const HostEmitter& of) {
    const bool counts = counts_in_simulation(*host, of);
    if (counts)
        all.push_back(
            item_pass(options_of(host, "simulate", counter_buffer), SimulatedCountTwin{frame_of(host, of, 0)}));
    ItemPassOptions stepping = options_of(host, counts ? "simulate_particles" : "simulate", particle_buffer, counts);
    if (host->lists())
        all.push_back(item_pass(std::move(stepping), SimulateListedTwin{frame_of(host, of, 0)}));
    else
        all.push_back(item_pass(std::move(stepping), SimulateTwin{frame_of(host, of, 0)}));
}

} // namespace lockstep::lifecycle
