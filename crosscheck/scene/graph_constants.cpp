#include "crosscheck/scene/graph_constants.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {

void GraphConstants::add(const Graph& graph, std::size_t node) {
    const GraphNode& of = graph.nodes[node];
    for (std::size_t c = 0; c < graph_components(of.makes); ++c)
        known_[node][c] = folded(graph, of, c);
}

std::optional<float> GraphConstants::at(const Graph& graph, const GraphSource& source, std::size_t component) const {
    if (!source.node)
        return source.numbers[component];
    const bool is_one = source.part < 0 && graph.nodes[*source.node].makes == GraphType::real;
    return known_[*source.node][is_one ? 0 : source.part < 0 ? component : static_cast<std::size_t>(source.part)];
}

std::optional<float> GraphConstants::folded(const Graph& graph, const GraphNode& node, std::size_t component) const {
    if (node.kind == GraphKind::constant)
        return node.value.numbers[component];
    if (node.kind == GraphKind::compose)
        return at(graph, node.inputs[component], 0);
    std::array<float, 3> x{};
    if (node.inputs.empty() || node.inputs.size() > x.size())
        return {};
    for (std::size_t p = 0; p < node.inputs.size(); ++p) {
        const auto known = at(graph, node.inputs[p], component);
        if (!known)
            return {};
        x[p] = *known;
    }
    switch (node.kind) {
    case GraphKind::split:
        return x[0];
    case GraphKind::add:
        return x[0] + x[1];
    case GraphKind::subtract:
        return x[0] - x[1];
    case GraphKind::multiply:
        return x[0] * x[1];
    case GraphKind::divide:
        return x[0] / x[1];
    case GraphKind::negate:
        return -x[0];
    case GraphKind::abs:
        return std::abs(x[0]);
    case GraphKind::floor:
        return std::floor(x[0]);
    case GraphKind::fract:
        return x[0] - std::floor(x[0]);
    case GraphKind::sqrt:
        return std::sqrt(x[0]);
    case GraphKind::min:
        return std::min(x[0], x[1]);
    case GraphKind::max:
        return std::max(x[0], x[1]);
    case GraphKind::clamp:
        return std::min(std::max(x[0], x[1]), x[2]);
    case GraphKind::mix:
        return x[0] + x[2] * (x[1] - x[0]);
    case GraphKind::step:
        return x[1] < x[0] ? 0.0F : 1.0F;
    default:
        return {};
    }
}

} // namespace lockstep
