#include "reference/lifecycle/move_fast.hpp"
#include "reference/lifecycle/move_twin.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_move(Passes& all, const HostPtr& host, const HostEmitter& of) {
    const bool counts = host->switches().fuse == Fuse::fused && counts_in_simulation(*host, of);
    if (counts)
        all.push_back(item_pass(options_of(host, "move", counter_buffer), SimulatedCountTwin{frame_of(host, of, 0)}));
    ItemPassOptions moving = options_of(host, counts ? "move_particles" : "move", particle_buffer, counts);
    if (has_move_fast(*host, of)) {
        moving.in_place = [host, one = &of](const PassInput& in) { return nothing_moves(*host, *one, in); };
        moving.fast = [host, one = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                        const WritableView& after, std::vector<std::size_t>& left) {
            move_fast(*host, *one, in, first, last, after, left);
        };
    }
    all.push_back(item_pass(std::move(moving), MoveTwin{frame_of(host, of, 0)}));
}

void add_simulate(Passes& all, const HostPtr& host, const HostEmitter& of) {
    const bool counts = counts_in_simulation(*host, of);
    if (counts)
        all.push_back(
            item_pass(options_of(host, "simulate", counter_buffer), SimulatedCountTwin{frame_of(host, of, 0)}));
    ItemPassOptions stepping = options_of(host, counts ? "simulate_particles" : "simulate", particle_buffer, counts);
    if (has_move_fast(*host, of)) {
        stepping.in_place = from_any_state;
        stepping.fast = [host, one = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                          const WritableView& after, std::vector<std::size_t>&) {
            simulate_fast(*host, *one, in, first, last, after);
        };
    }
    if (host->lists())
        all.push_back(item_pass(std::move(stepping), SimulateListedTwin{frame_of(host, of, 0)}));
    else
        all.push_back(item_pass(std::move(stepping), SimulateTwin{frame_of(host, of, 0)}));
}

} // namespace lockstep::lifecycle
