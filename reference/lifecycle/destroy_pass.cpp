#include "reference/lifecycle/destroy_twin.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_destroy(Passes& all, const HostPtr& host, const HostEmitter& of) {
    if (host->switches().compaction == Compaction::scan) {
        all.push_back(item_pass(options_of(host, "destroy_reduce", sum_buffer), DestroyReduceTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_scan", counter_buffer), SurvivorCountTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_scan_sums", sum_buffer, true), DestroyScanTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy", survivor_buffer), DestroyTwin{host, &of}));
    } else {
        all.push_back(item_pass(options_of(host, "destroy", survivor_buffer), DestroyTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_count", counter_buffer, true), AppendCountTwin{host, &of}));
    }
}

} // namespace lockstep::lifecycle
