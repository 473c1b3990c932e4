#include "reference/lifecycle/destroy_fast.hpp"
#include "reference/lifecycle/destroy_twin.hpp"
#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"

namespace lockstep::lifecycle {

void add_destroy(Passes& all, const HostPtr& host, const HostEmitter& of) {
    ItemPassOptions listing = options_of(host, "destroy", survivor_buffer);
    listing.fast = [host, of = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                    const WritableView& after,
                                    std::vector<std::size_t>&) { destroy_fast(*host, *of, in, first, last, after); };
    if (host->switches().compaction == Compaction::atomic)
        listing.appended = [host, of = &of](const PassInput& in) { return survivors_of(*host, *of, in); };
    ItemPassOptions burying = options_of(host, "destroy_dead", dead_buffer, true);
    burying.fast = [host, of = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                    const WritableView& after,
                                    std::vector<std::size_t>&) { bury_fast(*host, *of, in, first, last, after); };
    if (host->switches().compaction == Compaction::atomic)
        burying.appended = [host, of = &of](const PassInput& in) { return dead_of(*host, *of, in); };
    if (host->switches().compaction == Compaction::scan) {
        all.push_back(item_pass(options_of(host, "destroy_reduce", sum_buffer), DestroyReduceTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_scan", counter_buffer), SurvivorCountTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_scan_sums", sum_buffer, true), DestroyScanTwin{host, &of}));
        all.push_back(item_pass(std::move(listing), DestroyTwin{host, &of}));
    } else {
        all.push_back(item_pass(std::move(listing), AppendTwin{host, &of}));
        all.push_back(item_pass(options_of(host, "destroy_count", counter_buffer, true), AppendCountTwin{host, &of}));
    }
    if (host->lists())
        all.push_back(item_pass(std::move(burying), DeadTwin{host, &of}));
}

} // namespace lockstep::lifecycle
