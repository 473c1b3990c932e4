#include "reference/lifecycle/count_twin.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_post_destroy(Passes& all, const HostPtr& host, const HostEmitter& of) {
    all.push_back(item_pass(options_of(host, "post_destroy", counter_buffer), PostDestroyTwin{host, &of}));
    if (host->switches().emit_when == EmitWhen::before_destroy)
        all.push_back(item_pass(options_of(host, "post_destroy_ring", ring_buffer, true), RingTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "post_destroy_arguments", argument_buffer, true),
                            PostArgumentsTwin{host, &of, true}));
}

void add_post_emit(Passes& all, const HostPtr& host, const HostEmitter& of) {
    all.push_back(item_pass(options_of(host, "post_emit", counter_buffer), PostEmitTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "post_emit_ring", ring_buffer, true), RingTwin{host, &of}));
    all.push_back(
        item_pass(options_of(host, "post_emit_arguments", argument_buffer, true), PostArgumentsTwin{host, &of, false}));
}

void add_indirect(Passes& all, const HostPtr& host, const HostEmitter& of) {
    all.push_back(item_pass(options_of(host, "indirect", counter_buffer), IndirectCountersTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "indirect_arguments", argument_buffer, true), IndirectTwin{host, &of}));
}

} // namespace lockstep::lifecycle
