#include "gpu/lifecycle/graphs.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "gpu/graph_glsl.hpp"

namespace lockstep::lifecycle {
namespace {

using NamedValues = std::map<std::string_view, std::string_view>;

/// What the stages hand a graph, as their shaders have it.
const NamedValues& of_birth() {
    static const NamedValues all{{"serial", "serial"},
                                 {"order_in_frame", "k"},
                                 {"emitted", "emitted"},
                                 {"time", "u_Time"},
                                 {"frame", "u_Frame"},
                                 {"emitter_position", "u_Origin"},
                                 {"emitter_velocity", "u_OriginVelocity"}};
    return all;
}

const NamedValues& of_particle() {
    static const NamedValues all{{"position", "position()"},
                                 {"velocity", "velocity()"},
                                 {"acceleration", "acceleration()"},
                                 {"remaining", "in_seconds(remaining())"},
                                 {"lifetime", "in_seconds(lifetime())"},
                                 {"t", "age()"},
                                 {"spawn_time", "in_seconds(spawn_time())"},
                                 {"time", "u_Time"},
                                 {"tick", "u_Tick"},
                                 {"initial_size", "sizes().x"},
                                 {"end_size", "sizes().y"},
                                 {"initial_color", "initial_color()"},
                                 {"end_color", "end_color()"},
                                 {"u", "u"},
                                 {"v", "v"}};
    return all;
}

/// The statements, between the inputs that they need and `made`, a line for each output: "b.position = {};".
std::string body(const Graph& graph, const NamedValues& inputs, const NamedValues& outputs,
                 const std::string& parameters, const std::string& indent) {
    std::string text, made;
    bool needs_serial = false;
    const auto declare = [&](const GraphStage::Value& input) {
        text +=
            fmt::format("{}{} i_{} = {};\n", indent, graph_type_name(input.type), input.name, inputs.at(input.name));
    };
    std::vector<bool> declared(graph.stage->inputs.size(), false);
    for (const std::size_t n : graph.order) {
        const GraphNode& node = graph.nodes[n];
        needs_serial = needs_serial || node.kind == GraphKind::random;
        if (node.kind == GraphKind::input && !declared[node.of_stage]) {
            declared[node.of_stage] = true;
            declare(graph.stage->inputs[node.of_stage]);
        }
    }
    for (std::size_t i = 0; needs_serial && i < declared.size(); ++i)
        if (graph.stage->inputs[i].name == "serial" && !declared[i])
            declare(graph.stage->inputs[i]);
    for (const Graph::Output& output : graph.outputs)
        made += indent +
                fmt::format(fmt::runtime(outputs.at(graph.stage->outputs[output.of_stage].name)),
                            graph_output(graph, output)) +
                "\n";
    return text + graph_statements(graph, indent, parameters) + made;
}

std::string emission_text(const Graph& graph) {
    static const NamedValues outputs{{"position", "b.position = {};"},         {"velocity", "b.velocity = {};"},
                                     {"acceleration", "b.acceleration = {};"}, {"lifetime", "b.lifetime = {};"},
                                     {"initial_size", "b.sizes.x = {};"},      {"end_size", "b.sizes.y = {};"},
                                     {"initial_color", "b.color = {};"},       {"end_color", "b.end_color = {};"}};
    return "#include \"graph_nodes.glsl\"\nuniform vec3 u_OriginVelocity;\n" + graph_uniforms(graph, "e") +
           "void graph_birth(inout Birth b, uint serial, uint k, uint emitted) {\n" +
           body(graph, of_birth(), outputs, "e", "    ") + "}\n";
}

std::string simulation_text(const Graph& graph) {
    static const NamedValues outputs{{"acceleration", "m.acceleration = {};"},
                                     {"drag",
                                      "float graph_drag = {};\n"
                                      "#if DRAG == DRAG_EXPLICIT\n"
                                      "    m.acceleration = sub(m.acceleration, mul(v, graph_drag));\n"
                                      "#else\n"
                                      "    m.drag = mul(m.drag, ls_divide(1.0, add(1.0, mul(graph_drag, u_Tick))));\n"
                                      "#endif"},
                                     {"kill", "m.killed = {};"},
                                     {"velocity", "m.velocity = {};"},
                                     {"position", "m.position = {};"}};
    std::string defines;
    for (const char* const name : {"velocity", "position"})
        if (output_named(graph, name) != nullptr)
            defines += std::string("#define GRAPH_") + (name[0] == 'v' ? "VELOCITY" : "POSITION") + "\n";
    return defines +
           "#include \"graph_nodes.glsl\"\n#include \"appearance.glsl\"\n#include \"seconds.glsl\"\n"
           "uniform float u_Time;\n" +
           graph_uniforms(graph, "s") + "void graph_motion(inout Motion m, vec3 p, vec3 v) {\n" +
           body(graph, of_particle(), outputs, "s", "    ") + "}\n";
}

std::string parameters_of(const HostEmitter& of) { return fmt::format("p{}_", of.number); }

void add(Uniforms& all, const Graph& graph, const std::string& parameters) {
    for (const auto& [name, value] : graph_parameters(graph, parameters))
        all[name] = value;
}

} // namespace

ShaderTexts stage_texts(const Emitter& emitter) {
    ShaderTexts all;
    if (emitter.emission)
        all["emission_graph.glsl"] = emission_text(*emitter.emission);
    if (emitter.simulation)
        all["simulation_graph.glsl"] = simulation_text(*emitter.simulation);
    return all;
}

void add_stage_parameters(Uniforms& all, const Emitter& emitter) {
    // A pass includes one of them at most.
    if (emitter.emission)
        add(all, *emitter.emission, "e");
    if (emitter.simulation)
        add(all, *emitter.simulation, "s");
}

ShaderTexts rendering_texts(const Host& host) {
    static const NamedValues outputs{{"size", "size = {};"}, {"color", "color = {};"}};
    std::string uniforms, calls;
    for (const HostEmitter& of : host.emitters())
        if (const GraphPtr& graph = of.settings().rendering) {
            uniforms += graph_uniforms(*graph, parameters_of(of));
            calls += fmt::format("    if (quad >= {}u && quad < {}u) {{\n{}    }}\n", of.base, of.base + of.slots,
                                 body(*graph, of_particle(), outputs, parameters_of(of), "        "));
        }
    if (calls.empty())
        return {};
    return {{"rendering_graph.glsl",
             "#include \"graph_nodes.glsl\"\n#include \"seconds.glsl\"\n" + uniforms +
                 "void graph_look(uint quad, float u, float v, inout float size, inout vec4 color) {\n" + calls +
                 "}\n"}};
}

ShaderDefines rendering_defines(const Host& host) {
    std::map<std::string, bool> names;
    for (const HostEmitter& of : host.emitters())
        if (const GraphPtr& graph = of.settings().rendering) {
            names["RENDERING_GRAPH"] = true;
            for (const auto& [input, define] : NamedValues{{"velocity", "LOOKS_BY_VELOCITY"},
                                                           {"acceleration", "LOOKS_BY_ACCELERATION"},
                                                           {"spawn_time", "LOOKS_BY_SPAWN_TIME"}})
                if (reads_input(*graph, input))
                    names[std::string(define)] = true;
        }
    ShaderDefines all;
    for (const auto& [name, is_there] : names)
        all.emplace_back(name, "1");
    return all;
}

void add_rendering_parameters(Uniforms& all, const Host& host) {
    for (const HostEmitter& of : host.emitters())
        if (const GraphPtr& graph = of.settings().rendering)
            add(all, *graph, parameters_of(of));
}

} // namespace lockstep::lifecycle
