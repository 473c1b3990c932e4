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

using namespace lockstep;

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

} // namespace

TEST_CASE("graphs: every node has the same bits as GLSL and interpreted") {
    if (!gl())
        return test::skip(gl().missing());
    for (const ArithmeticSwitch arithmetic : {ArithmeticSwitch::exact, ArithmeticSwitch::plain})
        for (const GraphPtr& graph : {graph_of(every_node), shipped("fire"), shipped("fade")}) {
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
