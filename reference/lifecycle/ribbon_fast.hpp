#pragma once
#include "reference/model/lifecycle/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lifecycle {

/// The sums within blocks of 256, items first to last, as PrefixReduceTwin makes them item by item: of a block at once.
void prefix_reduce_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first,
                        std::size_t last, const WritableView& after);

/// A step of the bitonic network, with the bits of SortTwin.
void sort_fast(const HostEmitter& of, std::uint32_t run, std::uint32_t apart, const PassInput& in, std::size_t first,
               std::size_t last, const WritableView& after);

} // namespace lockstep::lifecycle
