#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"
#include "reference/lifecycle/ribbon_points_twin.hpp"
#include "reference/lifecycle/ribbon_twin.hpp"
#include "reference/lifecycle/sort_twin.hpp"
#include "reference/model/lifecycle/sort_steps.hpp"

namespace lockstep::lifecycle {

void add_ribbon(Passes& all, const HostPtr& host, const HostEmitter& of) {
    if (host->lists()) {
        all.push_back(item_pass(options_of(host, "pre_sort", key_buffer), PreSortTwin{host, &of}));
        for_each_sort_step(of.keys, [&](std::uint32_t run, std::uint32_t apart) {
            all.push_back(item_pass(options_of(host, "sort", key_buffer), SortTwin{host, &of, run, apart}));
        });
    }
    all.push_back(item_pass(options_of(host, "ribbon_distance", particle_buffer), RibbonDistanceTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "prefix_reduce", length_buffer), PrefixReduceTwin{host, &of}));
    all.push_back(
        item_pass(options_of(host, "prefix_reduce_sums", block_length_buffer, true), BlockLengthTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "prefix_scan", block_length_buffer), PrefixScanTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "prefix_sum", length_buffer), PrefixSumTwin{host, &of}));
    all.push_back(
        item_pass(options_of(host, "prefix_sum_particles", particle_buffer, true), StartDistanceTwin{host, &of}));
    all.push_back(item_pass(options_of(host, "ribbon", point_buffer),
                            RibbonPointsTwin{host, &of, view_matrix(host->settings().camera)}));
}

} // namespace lockstep::lifecycle
