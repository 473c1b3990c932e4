#include "reference/lifecycle/pass_options.hpp"
#include "reference/lifecycle/passes.hpp"
#include "reference/lifecycle/ribbon_fast.hpp"
#include "reference/lifecycle/ribbon_points_twin.hpp"
#include "reference/lifecycle/ribbon_twin.hpp"
#include "reference/lifecycle/sort_twin.hpp"
#include "reference/model/lifecycle/sort_steps.hpp"

namespace lockstep::lifecycle {

void add_ribbon(Passes& all, const HostPtr& host, const HostEmitter& of) {
    if (host->lists()) {
        all.push_back(item_pass(options_of(host, "pre_sort", key_buffer), PreSortTwin{host, &of}));
        for_each_sort_step(of.keys, [&](std::uint32_t run, std::uint32_t apart) {
            ItemPassOptions sorting = options_of(host, "sort", key_buffer);
            sorting.fast = [one = &of, run, apart](const PassInput& in, const Profile&, std::size_t first,
                                                   std::size_t last, const WritableView& after,
                                                   std::vector<std::size_t>&) {
                sort_fast(*one, run, apart, in, first, last, after);
            };
            all.push_back(item_pass(std::move(sorting), SortTwin{host, &of, run, apart}));
        });
    }
    all.push_back(item_pass(options_of(host, "ribbon_distance", particle_buffer), RibbonDistanceTwin{host, &of}));
    ItemPassOptions reducing = options_of(host, "prefix_reduce", length_buffer);
    reducing.fast = [host, one = &of](const PassInput& in, const Profile&, std::size_t first, std::size_t last,
                                      const WritableView& after, std::vector<std::size_t>&) {
        prefix_reduce_fast(*host, *one, in, first, last, after);
    };
    all.push_back(item_pass(std::move(reducing), PrefixReduceTwin{host, &of}));
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
