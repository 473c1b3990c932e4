#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reference/interval.hpp"
#include "reference/model/graph.hpp"
#include "reference/system/graph_twin.hpp"

namespace lockstep {

/// What each node of a graph may make, whatever its inputs, parameters and random numbers are: sets of floats. The
/// graph's twin finds them over the reading of sets (worlds.hpp), a node at a time; compilers fold what is one float.
class GraphConstants {
  public:
    /// `graph` outlives this. Its nodes have their names.
    explicit GraphConstants(const Graph& graph) : graph_(graph), sites_(graph), made_(graph.nodes.size()) {}

    /// Takes up a node whose types are known; those that it needs were taken up before. Returns what the node does that
    /// GLSL leaves undefined wherever it comes to it, as "divides by 0"; empty: nothing.
    std::string add(std::size_t node);

    /// A component of what comes from a source.
    [[nodiscard]] Interval at(const GraphSource& source, std::size_t component) const;

    struct Made {
        std::array<Interval, 4> x{};
        bool may_be_false = false, may_be_true = false; ///< of a truth; of a uint both
    };

  private:
    const Graph& graph_;
    GraphSites sites_;
    std::vector<Made> made_;
};

} // namespace lockstep
