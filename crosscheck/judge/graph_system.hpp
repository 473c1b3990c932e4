#pragma once
#include <string>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/graph.hpp"

namespace lockstep {

/// A graph as a system of one pass, `graph`: for each of `items` made-up inputs of its stage, what it makes of them.
/// `seed`: of the inputs. The first are special ones: 0, 1, and alike.
SystemScene graph_system(const GraphPtr& graph, const std::string& name, std::size_t items, std::uint64_t seed,
                         ArithmeticSwitch arithmetic);

/// What each node makes of such an item, in the order of evaluation, and the outputs: a line each, in hexadecimal.
std::string graph_values(const GraphPtr& graph, std::size_t item, std::uint64_t seed);

} // namespace lockstep
