#include "reference/model/graph.hpp"

#include <algorithm>

namespace lockstep {

std::string_view graph_type_name(GraphType type) {
    static constexpr std::array<std::string_view, 6> names{"float", "vec2", "vec3", "vec4", "uint", "bool"};
    return names[static_cast<std::size_t>(type)];
}

std::span<const GraphNodeType> graph_node_types() {
    using enum GraphKind;
    using W = GraphWants;
    static const std::vector<GraphPort> one{{"a"}}, two{{"a"}, {"b"}};
    static const std::vector<GraphPort> two_truths{{"a", W::boolean}, {"b", W::boolean}};
    static const std::vector<GraphNodeType> all{
        {constant, "constant", {}, W::any, {"value"}},
        {parameter, "parameter", {}, W::any, {"value", "range"}},
        {input, "input", {}, W::any, {"value"}},
        {add, "add", two},
        {subtract, "subtract", two},
        {multiply, "multiply", two},
        {divide, "divide", two},
        {negate, "negate", one},
        {abs, "abs", one},
        {floor, "floor", one},
        {fract, "fract", one},
        {min, "min", two},
        {max, "max", two},
        {clamp, "clamp", {{"a"}, {"low", W::shared, 0.0F}, {"high", W::shared, 1.0F}}},
        {mix, "mix", {{"a"}, {"b"}, {"t", W::real}}},
        {step, "step", {{"edge"}, {"a"}}},
        {smoothstep, "smoothstep", {{"low", W::shared, 0.0F}, {"high", W::shared, 1.0F}, {"a"}}},
        {sqrt, "sqrt", one},
        {dot, "dot", {{"a", W::vec3}, {"b", W::vec3}}, W::real},
        {cross, "cross", {{"a", W::vec3}, {"b", W::vec3}}, W::vec3},
        {length, "length", {{"a", W::vec3}}, W::real},
        {normalize, "normalize", {{"a", W::vec3}}, W::vec3},
        {compose, "compose", {{"x", W::real}, {"y", W::real}, {"z", W::part}, {"w", W::part}}, W::vector},
        {split, "split", {{"a", W::vector}}, W::vector},
        {less, "less", {{"a", W::real}, {"b", W::real}}, W::boolean},
        {equal, "equal", {{"a", W::any}, {"b", W::any}}, W::boolean},
        {logical_and, "and", two_truths, W::boolean},
        {logical_or, "or", two_truths, W::boolean},
        {logical_not, "not", {{"a", W::boolean}}, W::boolean},
        {select, "select", {{"condition", W::boolean}, {"a", W::any}, {"b", W::any}}, W::any},
        {curve, "curve", {{"t", W::real}}, W::real, {"keys"}},
        {sin_turns, "sin_turns", one},
        {cos_turns, "cos_turns", one},
        {random, "random", {}, W::any, {"channel", "values"}, "emission"},
        {noise, "noise", {{"at", W::vec3}}, W::vec3, {"seed"}},
        {noise_gradient, "noise_gradient", {{"at", W::vec3}}, W::vec3, {"seed", "potential"}},
        {curl_noise,
         "curl_noise",
         {{"position", W::vec3}, {"frequency", W::real, 1.0F}, {"offset", W::vec3, 0.0F}, {"strength", W::real, 1.0F}},
         W::vec3,
         {"seed"}},
        {drag, "drag", {{"velocity", W::vec3}, {"k", W::real}}, W::vec3},
        {vortex,
         "vortex",
         {{"position", W::vec3},
          {"axis", W::vec3},
          {"centre", W::vec3, 0.0F},
          {"strength", W::real, 1.0F},
          {"radius", W::real, 1.0F},
          {"pull", W::real, 0.0F}},
         W::vec3,
         {"falloff"}},
        {point_attraction,
         "point_attraction",
         {{"position", W::vec3},
          {"centre", W::vec3, 0.0F},
          {"strength", W::real, 1.0F},
          {"radius", W::real, 1.0F},
          {"softening", W::real, 0.1F}},
         W::vec3,
         {"falloff", "law"}},
        {point, "point", {{"centre", W::vec3}}, W::vec3},
        {box, "box", {{"u", W::vec3}, {"min", W::vec3}, {"max", W::vec3}}, W::vec3},
        {sphere, "sphere", {{"u", W::vec3}, {"centre", W::vec3, 0.0F}, {"radius", W::real, 1.0F}}, W::vec3},
        {cone, "cone", {{"u", W::vec3}}, W::vec3, {"direction", "angle"}},
    };
    return all;
}

std::span<const GraphStage> graph_stages() {
    using enum GraphType;
    static const std::vector<GraphStage> all{
        {"simulation",
         {{"position", vec3},
          {"velocity", vec3},
          {"acceleration", vec3},
          {"remaining", real},
          {"lifetime", real},
          {"t", real},
          {"spawn_time", real},
          {"time", real},
          {"tick", real}},
         {{"acceleration", vec3}, {"drag", real}, {"kill", boolean}, {"velocity", vec3}, {"position", vec3}}},
        {"emission",
         {{"serial", uint},
          {"order_in_frame", uint},
          {"emitted", uint},
          {"time", real},
          {"frame", uint},
          {"emitter_position", vec3},
          {"emitter_velocity", vec3}},
         {{"position", vec3},
          {"velocity", vec3},
          {"acceleration", vec3},
          {"lifetime", real},
          {"initial_size", real},
          {"end_size", real},
          {"initial_color", vec4},
          {"end_color", vec4}}},
        {"rendering",
         {{"position", vec3},
          {"velocity", vec3},
          {"acceleration", vec3},
          {"remaining", real},
          {"lifetime", real},
          {"t", real},
          {"spawn_time", real},
          {"time", real},
          {"tick", real},
          {"initial_size", real},
          {"end_size", real},
          {"initial_color", vec4},
          {"end_color", vec4},
          {"u", real},
          {"v", real}},
         {{"size", real}, {"color", vec4}}},
    };
    return all;
}

bool reads_input(const Graph& graph, std::string_view name) {
    return std::any_of(graph.order.begin(), graph.order.end(), [&](std::size_t n) {
        const GraphNode& node = graph.nodes[n];
        return node.kind == GraphKind::input && graph.stage->inputs[node.of_stage].name == name;
    });
}

const Graph::Output* output_named(const Graph& graph, std::string_view name) {
    for (const Graph::Output& output : graph.outputs)
        if (graph.stage->outputs[output.of_stage].name == name)
            return &output;
    return nullptr;
}

std::optional<float> graph_constant(const Graph& graph, const GraphSource& source, std::size_t component) {
    if (!source.node)
        return source.numbers[component];
    const GraphNode& from = graph.nodes[*source.node];
    if (from.kind != GraphKind::constant)
        return {};
    const bool is_one = source.part < 0 && from.makes == GraphType::real;
    return from.value.numbers[is_one ? 0 : source.part < 0 ? component : static_cast<std::size_t>(source.part)];
}

} // namespace lockstep
