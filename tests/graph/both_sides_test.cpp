#include <array>
#include <set>
#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/graph_system.hpp"
#include "crosscheck/scene/graph_file.hpp"
#include "gpu/graph_glsl.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::both_sides_test {

namespace {

const Gl& gl() {
    static const Gl one;
    return one;
}

GraphPtr shipped(const std::string& name) {
    return std::make_shared<const Graph>(load_graph("data/graphs/" + name + ".json"));
}

GraphPtr graph_of(const std::string& text) {
    const nlohmann::json document = nlohmann::json::parse(text);
    return std::make_shared<const Graph>(read_graph(JsonValue(document, "graph.json")));
}

/// Both sides, with a text of the shader changed.
CheckReport run(const GraphPtr& graph, ArithmeticSwitch arithmetic, const std::string& what = "",
                const std::string& by = "") {
    const SystemScene scene = graph_system(graph, "graph", 700, 3, arithmetic);
    std::vector<GlPass> passes = scene.passes;
    std::string& text = passes[0].texts.at("graph_statements.glsl");
    if (!what.empty()) {
        const std::size_t at = text.find(what);
        REQUIRE(at != std::string::npos);
        text.replace(at, what.size(), by);
    }
    GlSystemSide side(gl(), scene.system, passes, "", arithmetic);
    CheckOptions options;
    options.frames = 1;
    return check(scene.system, side, options);
}

/// The causes that explain everything.
std::set<std::string> causes_of(const CheckReport& report) {
    std::set<std::string> names;
    for (const CauseFindings& found : report.verdicts->causes)
        for (const Cause& cause : found.best)
            if (found.explains_all())
                names.insert(cause.name());
    return names;
}

/// Every type of node, of floats and of vectors.
const char* const every_node = R"({"stage": "rendering", "nodes": [
    {"id": "p", "type": "input", "value": "position"}, {"id": "v", "type": "input", "value": "velocity"},
    {"id": "t", "type": "input", "value": "t"}, {"id": "u", "type": "input", "value": "u"},
    {"id": "tint", "type": "constant", "value": [0.25, 0.5, 0.75, 1]},
    {"id": "k", "type": "parameter", "value": 1.7},
    {"id": "sum", "type": "add", "inputs": {"a": "p", "b": "v"}},
    {"id": "difference", "type": "subtract", "inputs": {"a": "sum", "b": "k"}},
    {"id": "product", "type": "multiply", "inputs": {"a": "difference", "b": [2, -3, 0.5]}},
    {"id": "quotient", "type": "divide", "inputs": {"a": "product", "b": "k"}},
    {"id": "minus", "type": "negate", "inputs": {"a": "quotient"}},
    {"id": "size", "type": "abs", "inputs": {"a": "minus"}},
    {"id": "whole", "type": "floor", "inputs": {"a": "size"}},
    {"id": "rest", "type": "fract", "inputs": {"a": "size"}},
    {"id": "least", "type": "min", "inputs": {"a": "whole", "b": "rest"}},
    {"id": "most", "type": "max", "inputs": {"a": "least", "b": "t"}},
    {"id": "within", "type": "clamp", "inputs": {"a": "most"}},
    {"id": "between", "type": "mix", "inputs": {"a": "within", "b": "v", "t": "u"}},
    {"id": "beyond", "type": "step", "inputs": {"edge": 0.25, "a": "between"}},
    {"id": "smooth", "type": "smoothstep", "inputs": {"low": -1, "high": "k", "a": "between"}},
    {"id": "root", "type": "sqrt", "inputs": {"a": "size"}},
    {"id": "scalar", "type": "dot", "inputs": {"a": "p", "b": "v"}},
    {"id": "normal", "type": "cross", "inputs": {"a": "p", "b": "v"}},
    {"id": "l", "type": "length", "inputs": {"a": "normal"}},
    {"id": "unit", "type": "normalize", "inputs": {"a": "p"}},
    {"id": "parts", "type": "split", "inputs": {"a": "unit"}},
    {"id": "flat", "type": "compose", "inputs": {"x": "parts.x", "y": "t"}},
    {"id": "flat_parts", "type": "split", "inputs": {"a": "flat"}},
    {"id": "is_less", "type": "less", "inputs": {"a": "scalar", "b": "l"}},
    {"id": "is_same", "type": "equal", "inputs": {"a": "p", "b": "v"}},
    {"id": "both", "type": "and", "inputs": {"a": "is_less", "b": "is_same"}},
    {"id": "either", "type": "or", "inputs": {"a": "is_less", "b": "both"}},
    {"id": "neither", "type": "not", "inputs": {"a": "either"}},
    {"id": "chosen", "type": "select", "inputs": {"condition": "neither", "a": "smooth", "b": "root"}},
    {"id": "more", "type": "add", "inputs": {"a": "chosen", "b": "beyond"}},
    {"id": "its", "type": "split", "inputs": {"a": "more"}},
    {"id": "bent", "type": "curve", "inputs": {"t": "t"}, "keys": [[-2, 3], [0, 0.5], [0.5, -1], [4, 2]]},
    {"id": "color", "type": "compose",
     "inputs": {"x": "its.x", "y": "its.y", "z": "flat_parts.x", "w": "bent"}},
    {"id": "tinted", "type": "multiply", "inputs": {"a": "color", "b": "tint"}}
  ], "outputs": {"color": "tinted", "size": "its.z"}})";

/// Random numbers, shapes, noise and forces.
const char* const every_field = R"({"stage": "emission", "nodes": [
    {"id": "time", "type": "input", "value": "time"},
    {"id": "from", "type": "input", "value": "emitter_position"},
    {"id": "speed", "type": "input", "value": "emitter_velocity"},
    {"id": "u", "type": "random", "values": 3},
    {"id": "pair", "type": "random", "values": 2, "channel": 7},
    {"id": "one", "type": "random", "channel": 4294967295},
    {"id": "both", "type": "split", "inputs": {"a": "pair"}},
    {"id": "sine", "type": "sin_turns", "inputs": {"a": "from"}},
    {"id": "cosine", "type": "cos_turns", "inputs": {"a": "time"}},
    {"id": "middle", "type": "point", "inputs": {"centre": "sine"}},
    {"id": "crate", "type": "box", "inputs": {"u": "u", "min": "middle", "max": [2, 3, 0.5]}},
    {"id": "ball", "type": "sphere", "inputs": {"u": "u", "centre": "crate", "radius": "cosine"}},
    {"id": "jet", "type": "cone", "inputs": {"u": "u"}, "direction": [0.2, 3, -1], "angle": 25},
    {"id": "psi", "type": "noise", "inputs": {"at": "from"}, "seed": 3},
    {"id": "slope", "type": "noise_gradient", "inputs": {"at": "from"}, "seed": 4, "potential": 2},
    {"id": "curl", "type": "curl_noise",
     "inputs": {"position": "ball", "frequency": 1.7, "offset": "psi", "strength": "cosine"}},
    {"id": "brake", "type": "drag", "inputs": {"velocity": "jet", "k": "both.x"}},
    {"id": "swirl", "type": "vortex", "falloff": 2,
     "inputs": {"position": "ball", "axis": "speed", "centre": [0, 0.1, 0], "strength": 3, "radius": 9, "pull": 0.5}},
    {"id": "pull", "type": "point_attraction", "inputs": {"position": "ball", "radius": 4, "strength": "one"}},
    {"id": "fall", "type": "point_attraction", "law": "inverse_square",
     "inputs": {"position": "ball", "centre": "slope", "softening": "both.y"}},
    {"id": "a", "type": "add", "inputs": {"a": "swirl", "b": "curl"}},
    {"id": "b", "type": "add", "inputs": {"a": "pull", "b": "fall"}},
    {"id": "c", "type": "add", "inputs": {"a": "brake", "b": "slope"}},
    {"id": "pushed", "type": "add", "inputs": {"a": "b", "b": "c"}}
  ], "outputs": {"position": "ball", "velocity": "pushed", "acceleration": "a", "initial_size": "cosine",
                 "end_color": [1, 0, 0, 1], "lifetime": "one"}})";

} // namespace

TEST_CASE("graphs: every node has the same bits as GLSL and interpreted") {
    if (!gl())
        return test::skip(gl().missing());
    for (const ArithmeticSwitch arithmetic : {ArithmeticSwitch::exact, ArithmeticSwitch::plain})
        for (const GraphPtr& graph : {graph_of(every_node), graph_of(every_field), shipped("fire"), shipped("fade")}) {
            const CheckReport report = run(graph, arithmetic);
            INFO(report_text(report, {}));
            CHECK((report.verdict == Verdict::agree ||
                   (arithmetic == ArithmeticSwitch::plain && report.verdict == Verdict::legal)));
        }
}

TEST_CASE("graphs: a node that is compiled wrongly is found, and named") {
    if (!gl())
        return test::skip(gl().missing());
    const GraphPtr graph = shipped("fire");
    const std::string k = "precise float n3 = ";
    const CheckReport wrong = run(graph, ArithmeticSwitch::exact, k, k + "2.0 * ");
    CHECK(wrong.verdict == Verdict::divergent);
    CHECK(causes_of(wrong).contains("node k: doubled"));
    const CheckReport never =
        run(graph, ArithmeticSwitch::exact, "outputs[i].kill = uint(o_kill);", "outputs[i].kill = 0u;");
    CHECK(never.verdict == Verdict::divergent);
    CHECK(causes_of(never).contains("node dies: never"));
}

TEST_CASE("graphs: a field that is compiled wrongly is found") {
    if (!gl())
        return test::skip(gl().missing());
    const GraphPtr graph = graph_of(every_field);
    for (const auto& [what, by, cause] : std::vector<std::array<std::string, 3>>{
             {"u_Seed, 7u", "u_Seed, 8u", ""},
             {"n5 = unit3(pcg3d(uvec3(i_serial", "n5 = unit3(pcg3d(uvec3(i_serial + 1u", ""},
             {"n8 = sine_cosine(n0).y", "n8 = sine_cosine(n0).x", ""},
             {"n13 = potentials(n1, 3u)", "n13 = potentials(n1, 2u)", ""},
             {"n14 = potential_gradient(n1, 1, ", "n14 = potential_gradient(n1, 2, ", ""},
             {"n10 = in_box(n3, ", "n10 = in_box(2.0 * n3, ", ""},
             {"n16 = sub(vec3(0.0), ", "n16 = add(vec3(0.0), ", "node brake: negated"},
             {"n17 = ", "n17 = 2.0 * ", "node swirl: doubled"},
             {"n18 = ", "n18 = -", "node pull: negated"},
             {"n19 = ", "n19 = 0.0 * ", "node fall: zero"}}) {
        const CheckReport report = run(graph, ArithmeticSwitch::exact, what, by);
        INFO(what);
        CHECK(report.verdict == Verdict::divergent);
        CHECK((cause.empty() || causes_of(report).contains(cause)));
    }
}

TEST_CASE("graphs: nodes are evaluated depth first, ports in their order, each once") {
    const GraphPtr graph = graph_of(R"({"stage": "simulation", "nodes": [
        {"id": "last", "type": "add", "inputs": {"b": "first", "a": "second"}},
        {"id": "first", "type": "negate", "inputs": {"a": "x"}},
        {"id": "second", "type": "abs", "inputs": {"a": "x"}},
        {"id": "x", "type": "input", "value": "t"}], "outputs": {"drag": "last"}})");
    CHECK(graph->order == std::vector<std::size_t>{3, 2, 1, 0});
    const std::string text = graph_texts(*graph).at("graph_statements.glsl");
    CHECK(text.find("n3 = i_t") < text.find("n2 = abs(n3)"));
    CHECK(text.find("n1 = sub(0.0, n3)") < text.find("n0 = add(n2, n1)"));
}

} // namespace lockstep::test::both_sides_test
