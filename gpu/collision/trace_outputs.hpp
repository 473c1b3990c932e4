#pragma once
#include <string_view>

namespace lockstep {

// What a trace build of the collision pass has beside the pass's own outputs (LOCKSTEP_TRACE).
inline constexpr std::string_view trace_prefix = "trace_";
inline constexpr std::string_view neighbour_prefix = "trace_neighbour_";
inline constexpr std::string_view neighbour_count = "trace_neighbour_count";
inline constexpr int most_neighbours = 65536;

} // namespace lockstep
