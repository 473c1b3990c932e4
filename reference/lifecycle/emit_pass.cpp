#include "reference/lifecycle/emit_twin.hpp"
#include "reference/lifecycle/move_fast.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_emit(Passes& all, const HostPtr& host, const HostEmitter& of) {
    if (host->lists()) {
        all.push_back(item_pass(options_of(host, "emit", particle_buffer), EmitListedTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "emit_list", survivor_buffer, true), EmitListTwin{host, &of}));
    } else {
        ItemPassOptions emitting = options_of(host, "emit", particle_buffer);
        emitting.in_place = true;
        emitting.fast = [host, one = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                          const WritableView& after, std::vector<std::size_t>& left) {
            emit_fast(*host, *one, in, first, last, after, left);
        };
        all.push_back(item_pass(std::move(emitting), EmitTwin{host, &of}));
    }
    all.push_back(item_pass(options_of(host, "emit_counters", counter_buffer, true), EmitCountersTwin{host, &of}));
    if (host->switches().emit_when == EmitWhen::before_destroy)
        all.push_back(
            item_pass(options_of(host, "emit_arguments", argument_buffer, true), EmitArgumentsTwin{host, &of}));
}

} // namespace lockstep::lifecycle
