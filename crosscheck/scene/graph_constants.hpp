#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "reference/model/graph.hpp"

namespace lockstep {

/// The components of nodes that follow from numbers of the graph alone, each operation rounded: compilers fold these.
class GraphConstants {
  public:
    explicit GraphConstants(std::size_t nodes) : known_(nodes) {}

    /// Takes up a node whose types are known. Those that it needs were taken up before.
    void add(const Graph& graph, std::size_t node);
    [[nodiscard]] std::optional<float> at(const Graph& graph, const GraphSource& source, std::size_t component) const;

  private:
    [[nodiscard]] std::optional<float> folded(const Graph& graph, const GraphNode& node, std::size_t component) const;

    std::vector<std::array<std::optional<float>, 4>> known_;
};

} // namespace lockstep
