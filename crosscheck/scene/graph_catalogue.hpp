#pragma once
#include <string>

namespace lockstep {

/// What graphs are made of, as JSON for an editor: the stages with their inputs and outputs, the types of nodes with
/// their ports, what ports take without a link, and the limits.
std::string graph_catalogue();

} // namespace lockstep
