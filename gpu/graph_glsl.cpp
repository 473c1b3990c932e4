#include "gpu/graph_glsl.hpp"

#include <bit>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lockstep {
namespace {

constexpr std::string_view parts = "xyzw";

std::string number(float x) { return fmt::format("ls_flush(uintBitsToFloat(0x{:08x}u))", std::bit_cast<unsigned>(x)); }

std::string number(const glm::vec3& v) {
    return fmt::format("vec3({}, {}, {})", number(v.x), number(v.y), number(v.z));
}

/// "vec3(a, b, c)"; of one its own.
std::string vector(const std::vector<std::string>& x) {
    return x.size() == 1 ? x[0] : fmt::format("vec{}({})", x.size(), fmt::join(x, ", "));
}

/// Component `c` of what comes from a source, as the type that takes it.
std::string part_of(const Graph& graph, const GraphSource& source, std::size_t c) {
    if (!source.node)
        return number(source.numbers[c]);
    const std::string name = fmt::format("n{}", *source.node);
    if (source.part >= 0)
        return fmt::format("{}.{}", name, parts[static_cast<std::size_t>(source.part)]);
    return graph_components(graph.nodes[*source.node].makes) > 1 ? fmt::format("{}.{}", name, parts[c]) : name;
}

std::string whole(const GraphSource& source) {
    if (source.node)
        return fmt::format("n{}", *source.node);
    return source.type == GraphType::boolean ? (source.whole != 0 ? "true" : "false")
                                             : fmt::format("{}u", source.whole);
}

std::string value(const Graph& graph, const GraphSource& source, GraphType type) {
    const std::size_t count = graph_components(type);
    if (count == 0)
        return whole(source);
    if (source.node && source.part < 0 && graph.nodes[*source.node].makes == type)
        return fmt::format("n{}", *source.node);
    std::vector<std::string> x;
    for (std::size_t c = 0; c < count; ++c)
        x.push_back(part_of(graph, source, c));
    return vector(x);
}

std::string curve(const GraphNode& node, const std::string& t) {
    const auto& keys = node.keys;
    std::string made = number(keys.back()[1]);
    for (std::size_t k = keys.size() - 1; k > 0; --k)
        made = fmt::format("{0} < {1} ? add({2}, mul(ls_divide(sub({0}, {3}), {4}), {5})) : {6}", t, number(keys[k][0]),
                           number(keys[k - 1][1]), number(keys[k - 1][0]), number(keys[k][0] - keys[k - 1][0]),
                           number(keys[k][1] - keys[k - 1][1]), made);
    return fmt::format("!({} < {}) ? {} : ({})", number(keys.front()[0]), t, number(keys.front()[1]), made);
}

std::string expression(const Graph& graph, const GraphNode& node, const std::string& own_uniform) {
    using enum GraphKind;
    const std::size_t count = graph_components(node.takes);
    const auto x = [&](std::size_t port, std::size_t c) { return part_of(graph, node.inputs[port], c); };
    const auto v = [&](std::size_t port) { return value(graph, node.inputs[port], GraphType::vec3); };
    const auto b = [&](std::size_t port) { return whole(node.inputs[port]); };
    // Component by component, of ports 0, 1, 2 as {0}, {1}, {2}.
    const auto each = [&](const char* form) {
        std::vector<std::string> all;
        for (std::size_t c = 0; c < count; ++c)
            all.push_back(fmt::format(fmt::runtime(form), x(0, c), node.inputs.size() > 1 ? x(1, c) : "",
                                      node.inputs.size() > 2 ? x(2, node.kind == mix ? 0 : c) : ""));
        return vector(all);
    };
    switch (node.kind) {
    case constant:
        return value(graph, node.value, node.makes);
    case parameter:
        return fmt::format("ls_flush({})", own_uniform);
    case input:
        return "i_" + std::string(graph.stage->inputs[node.of_stage].name);
    case add:
        return each("add({0}, {1})");
    case subtract:
        return each("sub({0}, {1})");
    case multiply:
        return each("mul({0}, {1})");
    case divide:
        return each("ls_divide({0}, {1})");
    case negate:
        return each("sub(0.0, {0})");
    case abs:
        return each("abs({0})");
    case floor:
        return each("floor({0})");
    case fract:
        return each("sub({0}, floor({0}))");
    case min:
        return each("smaller({0}, {1})");
    case max:
        return each("greater({0}, {1})");
    case clamp:
        return each("smaller(greater({0}, {1}), {2})");
    case mix:
        return each("add({0}, mul({2}, sub({1}, {0})))");
    case step:
        return each("({1} < {0} ? 0.0 : 1.0)");
    case smoothstep:
        return each("smoothly(smaller(greater(ls_divide(sub({2}, {0}), sub({1}, {0})), 0.0), 1.0))");
    case sqrt:
        return each("ls_sqrt({0})");
    case dot:
        return fmt::format("ls_dot({}, {})", v(0), v(1));
    case cross:
        return fmt::format("cross_of({}, {})", v(0), v(1));
    case length:
        return fmt::format("ls_length({})", v(0));
    case normalize:
        return fmt::format("ls_normalize({})", v(0));
    case compose: {
        std::vector<std::string> all;
        for (std::size_t c = 0; c < node.inputs.size(); ++c)
            all.push_back(x(c, 0));
        return vector(all);
    }
    case split:
        return value(graph, node.inputs[0], node.makes);
    case less:
        return fmt::format("{} < {}", x(0, 0), x(1, 0));
    case equal: {
        if (count == 0)
            return fmt::format("{} == {}", b(0), b(1));
        std::vector<std::string> all;
        for (std::size_t c = 0; c < count; ++c)
            all.push_back(fmt::format("{} == {}", x(0, c), x(1, c)));
        return fmt::format("{}", fmt::join(all, " && "));
    }
    case logical_and:
        return fmt::format("{} && {}", b(0), b(1));
    case logical_or:
        return fmt::format("{} || {}", b(0), b(1));
    case logical_not:
        return fmt::format("!{}", b(0));
    case select:
        return fmt::format("{} ? {} : {}", b(0), value(graph, node.inputs[1], node.takes),
                           value(graph, node.inputs[2], node.takes));
    case sin_turns:
        return each("sine_cosine({0}).x");
    case cos_turns:
        return each("sine_cosine({0}).y");
    case random:
        return fmt::format("unit3(pcg3d(uvec3(i_serial, u_Seed, {}u))){}", node.options.channel,
                           node.makes == GraphType::real   ? ".x"
                           : node.makes == GraphType::vec2 ? ".xy"
                                                           : "");
    case noise:
        return fmt::format("potentials({}, {}u)", v(0), node.options.seed);
    case noise_gradient:
        return fmt::format("potential_gradient({}, {}, {}u)", v(0), node.options.potential - 1, node.options.seed);
    case curl_noise:
        return fmt::format("curl_noise(add(mul({}, {}), {}), {}, {}u)", v(0), x(1, 0), v(2), x(3, 0),
                           node.options.seed);
    case drag:
        return fmt::format("sub(vec3(0.0), mul({}, {}))", v(0), x(1, 0));
    case vortex:
        return fmt::format("vortex(vec3(0.0), {}, {}, ls_normalize({}), {}, {}, {}.0, {})", v(0), v(2), v(1), x(3, 0),
                           x(4, 0), node.options.falloff, x(5, 0));
    case point_attraction:
        return fmt::format("attracted({}, {}, {}, {}, {}.0, {})", v(0), v(1), x(2, 0), x(3, 0), node.options.falloff,
                           node.options.inverse_square ? fmt::format("mul({0}, {0})", x(4, 0)) : "-1.0");
    case point:
        return v(0);
    case box:
        return fmt::format("in_box({}, {}, {})", v(0), v(1), v(2));
    case sphere:
        return fmt::format("add({}, mul(on_sphere({}), {}))", v(1), v(0), x(2, 0));
    case cone: {
        const Basis& basis = node.options.basis;
        return fmt::format("in_cone({}, {}, {}, {}, {})", v(0), number(basis.side), number(basis.up),
                           number(basis.ahead), number(node.options.cone_depth));
    }
    case curve:
        return lockstep::curve(node, x(0, 0));
    }
    return {};
}

} // namespace

std::string graph_uniforms(const Graph& graph, const std::string& parameters) {
    std::string text;
    for (const std::size_t n : graph.order)
        if (graph.nodes[n].kind == GraphKind::parameter)
            text += fmt::format("uniform float {}{}; // {}\n", parameters, n, graph.nodes[n].id);
    return text;
}

std::vector<std::pair<std::string, float>> graph_parameters(const Graph& graph, const std::string& parameters) {
    std::vector<std::pair<std::string, float>> all;
    for (const std::size_t n : graph.order)
        if (graph.nodes[n].kind == GraphKind::parameter)
            all.emplace_back(fmt::format("{}{}", parameters, n), graph.nodes[n].value.numbers[0]);
    return all;
}

std::string graph_statements(const Graph& graph, const std::string& indent, const std::string& parameters) {
    std::string text;
    for (const std::size_t n : graph.order) {
        const GraphNode& node = graph.nodes[n];
        text += fmt::format("{}{}{} n{} = {}; // {}\n", indent, graph_components(node.makes) > 0 ? "precise " : "",
                            graph_type_name(node.makes), n, expression(graph, node, fmt::format("{}{}", parameters, n)),
                            node.id);
    }
    return text;
}

std::string graph_output(const Graph& graph, const Graph::Output& output) {
    return value(graph, output.source, graph.stage->outputs[output.of_stage].type);
}

ShaderTexts graph_texts(const Graph& graph) {
    std::string inputs, reads, outputs, writes;
    const auto words = [](GraphType type, std::string_view name) {
        if (graph_components(type) == 0)
            return fmt::format("    uint {};\n", name);
        std::string all;
        for (std::size_t c = 0; c < graph_components(type); ++c)
            all += fmt::format("    float {}_{};\n", name, parts[c]);
        return all;
    };
    for (const auto& [name, type] : graph.stage->inputs) {
        inputs += words(type, name);
        std::vector<std::string> x;
        for (std::size_t c = 0; c < graph_components(type); ++c)
            x.push_back(fmt::format("ls_flush(inputs[i].{}_{})", name, parts[c]));
        reads += fmt::format("    {} i_{} = {};\n", graph_type_name(type), name,
                             x.empty() ? fmt::format("inputs[i].{}", name) : vector(x));
    }
    for (const Graph::Output& output : graph.outputs) {
        const auto& [name, type] = graph.stage->outputs[output.of_stage];
        outputs += words(type, name);
        writes += fmt::format("    {} o_{} = {};\n", graph_type_name(type), name, graph_output(graph, output));
        for (std::size_t c = 0; c < graph_components(type); ++c)
            writes += fmt::format("    outputs[i].{0}_{1} = o_{0}{2};\n", name, parts[c],
                                  graph_components(type) > 1 ? fmt::format(".{}", parts[c]) : "");
        if (graph_components(type) == 0)
            writes += fmt::format("    outputs[i].{0} = uint(o_{0});\n", name);
    }
    return {{"graph_words.glsl", fmt::format("struct Inputs {{\n{}}};\nstruct Outputs {{\n{}}};\n{}", inputs, outputs,
                                             graph_uniforms(graph))},
            {"graph_statements.glsl", reads + graph_statements(graph) + writes}};
}

} // namespace lockstep
