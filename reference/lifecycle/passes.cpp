#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

Passes twins(const HostPtr& host) {
    Passes all;
    const Switches& s = host->switches();
    for (const HostEmitter& of : host->emitters()) {
        if (s.emit_when == EmitWhen::before_destroy)
            add_emit(all, host, of);
        if (host->lists())
            add_simulate(all, host, of);
        add_destroy(all, host, of);
        if (!host->lists())
            add_move(all, host, of);
        add_post_destroy(all, host, of);
        if (!host->lists() && s.fuse == Fuse::split)
            add_simulate(all, host, of);
        if (s.emit_when == EmitWhen::after_simulation) {
            add_emit(all, host, of);
            add_post_emit(all, host, of);
        }
        if (of.settings().draw == Emitter::Draw::ribbon)
            add_ribbon(all, host, of);
        add_indirect(all, host, of);
    }
    return all;
}

} // namespace lockstep::lifecycle
