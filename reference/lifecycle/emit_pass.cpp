#include "reference/lifecycle/emit_twin.hpp"
#include "reference/lifecycle/move_fast.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

namespace {

/// With a way that makes many items at once.
template <class Fast>
ItemPassOptions with(ItemPassOptions options, const HostPtr& host, const HostEmitter& of, Fast fast) {
    options.fast = [host, one = &of, fast](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                           const WritableView& after, std::vector<std::size_t>& left) {
        fast(*host, *one, in, first, last, after, left);
    };
    return options;
}

} // namespace

void add_emit(Passes& all, const HostPtr& host, const HostEmitter& of) {
    ItemPassOptions emitting = options_of(host, "emit", particle_buffer);
    if (host->lists()) {
        all.push_back(item_pass(with(std::move(emitting), host, of, emit_listed_fast), EmitListedTwin{host, &of}));
        all.push_back(item_pass(with(options_of(host, "emit_list", survivor_buffer, true), host, of, emit_list_fast),
                                EmitListTwin{host, &of}));
    } else {
        emitting.in_place = from_any_state;
        all.push_back(item_pass(with(std::move(emitting), host, of, emit_fast), EmitTwin{host, &of}));
    }
    all.push_back(item_pass(options_of(host, "emit_counters", counter_buffer, true), EmitCountersTwin{host, &of}));
    if (host->switches().emit_when == EmitWhen::before_destroy)
        all.push_back(
            item_pass(options_of(host, "emit_arguments", argument_buffer, true), EmitArgumentsTwin{host, &of}));
}

} // namespace lockstep::lifecycle
