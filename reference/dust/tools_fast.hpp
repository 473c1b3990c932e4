#pragma once
#include <cstddef>
#include <vector>

#include "reference/dust/fast_blocks.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

/// Fast ways of the tools' kernels and of blasts (ItemPassOptions::fast): grains that surely stay as they are, many at
/// a time. The others go into `left`.

/// Of a kernel that changes living grains within a reach.
void reach_fast(const Host& host, const Reach& reach, const PassInput& in, std::size_t first, std::size_t last,
                const WritableView& after, std::vector<std::size_t>& left);

/// As far as the vacuum reaches, in every version of it.
Reach vacuum_reach(const Host& host, int frame);
/// As far as the frame's `ball`-th blast does.
Reach blast_reach(const Host& host, int frame, std::size_t ball);

/// Of emit, which changes dead ones.
void emit_fast(const Host& host, const PassInput& in, std::size_t first, std::size_t last, const WritableView& after,
               std::vector<std::size_t>& left);

} // namespace lockstep::dust
