#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/graph_file.hpp"
#include "reference/model/error.hpp"
#include "tests/cli/cli_checks.hpp"

namespace lockstep::test::broken_graphs_test {

using Catch::Contains;
using nlohmann::json;
using test::refusal;
using test::run_lockstep;

namespace {

json node(const std::string& id, const std::string& type, json inputs) {
    return {{"id", id}, {"type", type}, {"inputs", std::move(inputs)}};
}

json shipped(const std::string& name) {
    std::ifstream stream("data/graphs/" + name + ".json");
    return json::parse(stream);
}

json small_graph() {
    return {{"stage", "simulation"},
            {"nodes",
             {{{"id", "v"}, {"type", "input"}, {"value", "velocity"}},
              node("slow", "multiply", {{"a", "v"}, {"b", -0.8}})}},
            {"outputs", {{"acceleration", "slow"}}}};
}

/// What reading a text says; empty: nothing is wrong.
std::string error_of(const std::string& text) {
    try {
        const json document = parse_json(text, "graph.json");
        static_cast<void>(read_graph(JsonValue(document, "graph.json")));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}
std::string error_of(const json& graph) { return error_of(graph.dump()); }

json& inputs_of(json& graph, const std::string& id) {
    for (json& one : graph.at("nodes"))
        if (one.at("id") == id)
            return one.at("inputs");
    throw std::runtime_error("no node " + id);
}

/// A chain of `length` nodes, the last the output.
json chain(std::size_t length) {
    json graph = small_graph();
    for (std::size_t i = 0; i < length; ++i)
        graph["nodes"].push_back(
            node("c" + std::to_string(i), "negate", {{"a", i == 0 ? "v" : "c" + std::to_string(i - 1)}}));
    graph["outputs"]["acceleration"] = "c" + std::to_string(length - 1);
    return graph;
}

/// Broken graphs by what is wrong with them; each has to be refused with these words.
std::vector<std::pair<std::string, std::string>> broken_graphs() {
    std::vector<std::pair<std::string, std::string>> all;
    const auto add = [&](const json& graph, const std::string& words) { all.emplace_back(graph.dump(), words); };
    const json small = small_graph(), fire = shipped("fire"), fade = shipped("fade");
    // Cycles of every length up to 40, entered from the front and from within.
    for (std::size_t length = 1; length <= 40; ++length) {
        json graph = chain(length);
        inputs_of(graph, "c0")["a"] = "c" + std::to_string(length - 1);
        add(graph, "the nodes wait for each other: c");
        graph["outputs"]["acceleration"] = "slow";
        add(graph, "wait for each other");
    }
    // Every node's type, every port and every link misspelt; every needed port left out.
    for (const json& whole : {fire, fade})
        for (std::size_t n = 0; n < whole.at("nodes").size(); ++n) {
            json graph = whole;
            json& one = graph["nodes"][n];
            one["type"] = one["type"].get<std::string>() + "s";
            add(graph, "is no type of a node");
            graph = whole;
            graph["nodes"][n]["id"] = n == 0 ? "" : whole["nodes"][0]["id"].get<std::string>();
            add(graph, n == 0 ? "is no name of a node" : "already");
            graph = whole;
            graph["nodes"][n]["colour"] = 1;
            add(graph, "unknown key");
            if (!whole["nodes"][n].contains("inputs"))
                continue;
            for (const auto& [port, value] : whole["nodes"][n]["inputs"].items()) {
                graph = whole;
                graph["nodes"][n]["inputs"]["z" + port] = value;
                add(graph, "is no port of");
                graph = whole;
                graph["nodes"][n]["inputs"][port] = "nobody";
                add(graph, "is no node");
                graph = whole;
                graph["nodes"][n]["inputs"][port] = json::object();
                add(graph, "is not a finite number");
                const std::string type = whole["nodes"][n]["type"];
                const bool standard = (type == "clamp" && port != "a") || (type == "smoothstep" && port != "a") ||
                                      (type == "compose" && (port == "z" || port == "w"));
                graph = whole;
                graph["nodes"][n]["inputs"].erase(port);
                if (!standard)
                    add(graph, "has nothing at its port " + port);
            }
        }
    // Types.
    const json parts = {true, json::array({1, 2}), json::array({1, 2, 3, 4})};
    for (const char* const type : {"add", "subtract", "multiply", "divide", "min", "max"})
        for (const json& other : parts) {
            json graph = small;
            graph["nodes"].push_back(node("n", type, {{"a", "v"}, {"b", other}}));
            add(graph, "port b of 'n' gets a");
        }
    for (const char* const type : {"dot", "cross"})
        for (const json& other : parts) {
            json graph = small;
            graph["nodes"].push_back(node("n", type, {{"a", "v"}, {"b", other}}));
            add(graph, "right is a vec3");
        }
    for (const char* const type : {"and", "or"}) {
        json graph = small;
        graph["nodes"].push_back(node("n", type, {{"a", true}, {"b", "v"}}));
        add(graph, "port b of 'n' gets a vec3; right is a bool");
    }
    for (const char* const type : {"not", "negate", "length", "split", "curve"}) {
        json graph = small;
        json one = node("n", type, {{std::string(type) == "curve" ? "t" : "a", "truth"}});
        if (std::string(type) == "curve")
            one["keys"] = {{0, 1}};
        if (std::string(type) == "not")
            one["inputs"]["a"] = "v";
        graph["nodes"].push_back(one);
        graph["nodes"].push_back({{"id", "truth"}, {"type", "constant"}, {"value", true}});
        add(graph, "of 'n' gets a");
    }
    for (const auto& [output, wrong] : std::map<std::string, json>{{"acceleration", true},
                                                                   {"acceleration", "kill"},
                                                                   {"drag", "v"},
                                                                   {"kill", 1.0},
                                                                   {"kill", "v"},
                                                                   {"position", json::array({1, 2})}}) {
        json graph = small;
        graph["outputs"] = {{output, wrong == "kill" ? json("v2") : wrong}};
        graph["nodes"].push_back({{"id", "v2"}, {"type", "constant"}, {"value", {1, 2}}});
        add(graph, "output " + output + " gets a");
    }
    // Outputs and inputs of another stage, and of none.
    for (const char* const name : {"size", "color", "lifetime", "initial_size", "nothing", ""}) {
        json graph = small;
        graph["outputs"][name] = "v";
        add(graph, name == std::string("nothing") || name[0] == 0 ? "is no output of the stage" : "is an output of");
        graph = small;
        graph["nodes"][0]["value"] = std::string(name) + "_u";
        add(graph, "is no input of the stage simulation");
        graph.erase("stage");
        add(graph, "no stage has these outputs");
    }
    // Values.
    const auto with = [&](const json& one, const std::string& words) {
        json graph = small;
        graph["nodes"].push_back(one);
        add(graph, words);
    };
    with({{"id", "k"}, {"type", "parameter"}, {"value", 5}, {"range", {0, 4}}}, "5 is not within 0 to 4");
    with(node("k", "divide", {{"a", "v"}, {"b", 0}}), "'k' divides by 0");
    with(node("k", "divide", {{"a", "v"}, {"b", {1, 0, 2}}}), "'k' divides by 0");
    with(node("k", "smoothstep", {{"low", 1}, {"high", 1}, {"a", "v"}}), "'k' rises from 1 to 1");
    const auto folded = [&](const json& zero, const char* const divisor) {
        json graph = small;
        graph["nodes"].push_back(node("two", "add", {{"a", 1}, {"b", json::array({0.5, 1, 1})}}));
        graph["nodes"].push_back(node("parts", "split", {{"a", "two"}}));
        graph["nodes"].push_back(zero);
        graph["nodes"].push_back(node("k", "divide", {{"a", "v"}, {"b", divisor}}));
        add(graph, "'k' divides by 0");
    };
    folded(node("zero", "subtract", {{"a", "two"}, {"b", 2}}), "zero");
    folded(node("zero", "multiply", {{"a", "two"}, {"b", 0}}), "zero");
    folded(node("zero", "floor", {{"a", json::array({0.5, 1, 2})}}), "zero");
    folded(node("zero", "compose", {{"x", 1}, {"y", "parts.x"}, {"z", 0}}), "zero");
    folded(node("zero", "subtract", {{"a", "parts.y"}, {"b", "parts.z"}}), "zero");
    folded(node("zero", "mix", {{"a", 0}, {"b", "two"}, {"t", 0}}), "zero");
    folded(node("zero", "length", {{"a", json::array({0, 0, 0})}}), "zero");
    folded(node("zero", "dot", {{"a", json::array({1, 0, 0})}, {"b", json::array({0, 1, 0})}}), "zero");
    folded(node("zero", "cross", {{"a", json::array({1, 0, 0})}, {"b", json::array({2, 0, 0})}}), "zero");
    folded(node("zero", "normalize", {{"a", json::array({1, 0, 0})}}), "zero");
    folded(node("zero", "select", {{"condition", true}, {"a", 0}, {"b", 1}}), "zero");
    folded(node("zero", "sin_turns", {{"a", 0}}), "zero");
    folded(node("zero", "smoothstep", {{"low", 0}, {"high", 1}, {"a", -1}}), "zero");
    folded(node("zero", "drag", {{"velocity", json::array({0, 0, 0})}, {"k", 1}}), "zero");
    folded(node("zero", "multiply", {{"a", "v"}, {"b", 0}}), "zero");
    folded(node("zero", "dot", {{"a", "v"}, {"b", 0}}), "zero");
    json flat = node("zero", "curve", {{"t", 0.5}});
    flat["keys"] = {{0, 0}};
    folded(flat, "zero");
    // Other operations that GLSL leaves undefined.
    with(node("k", "sqrt", {{"a", -1}}), "'k' takes the square root of a number below 0");
    with(node("k", "normalize", {{"a", json::array({0, 0, 0})}}), "'k' normalizes a vector of length 0");
    with(node("k", "vortex", {{"position", "v"}, {"axis", json::array({0, 0, 0})}}),
         "'k' normalizes a vector of length 0");
    with(node("k", "vortex", {{"position", "v"}, {"axis", json::array({0, 1, 0})}, {"radius", 0}}),
         "'k' divides by 0 at every input that it comes to");
    with(node("k", "sphere", {{"u", json::array({2, 0, 0})}}), "'k' takes the square root of a number below 0");
    with({{"id", "k"}, {"type", "parameter"}, {"value", 5}, {"range", {9, 4}}}, "right is the least first");
    with({{"id", "k"}, {"type", "parameter"}, {"value", 5}, {"range", {9}}}, "right is the least and the greatest");
    with({{"id", "k"}, {"type", "parameter"}, {"value", {1, 2}}}, "a parameter is a float");
    with({{"id", "k"}, {"type", "constant"}}, "\"value\" is missing");
    with({{"id", "k"}, {"type", "constant"}, {"value", {1}}}, "right is two to four");
    with({{"id", "k"}, {"type", "constant"}, {"value", {1, 2, 3, 4, 5}}}, "right is two to four");
    with({{"id", "k"}, {"type", "constant"}, {"value", 1e39}}, "is beyond what a float holds, 3.4e38");
    with({{"id", "k"}, {"type", "constant"}, {"value", "v"}}, "is not a finite number");
    with({{"id", "k"}, {"type", "constant"}, {"value", nullptr}},
         "null is not a finite number, an array of two to four or a truth");
    with({{"id", "k"}, {"type", "negate"}, {"inputs", {{"a", nullptr}}}},
         "null is not a finite number, an array of two to four, a truth or a node's id");
    with({{"id", "k"}, {"type", "texture"}, {"file", "a.png"}}, "'texture' is no type of a node");
    with({{"id", "k"}, {"type", "constant"}, {"value", 1}, {"inputs", json::object()}}, "is no property of a node");
    with({{"id", "k"}, {"type", "add"}, {"value", 1}}, "is no property of a node");
    with({{"id", "k k"}, {"type", "add"}}, "is no name of a node");
    with({{"id", std::string(41, 'k')}, {"type", "add"}}, "is no name of a node");
    with({{"id", 7}, {"type", "add"}}, "7 is not a text");
    for (const json& keys :
         {json::array(), json{{0, 1}, {0, 2}}, json{{1, 1}, {0, 2}}, json{{0}}, json{{0, 1, 2}}, json{1, 2},
          json{{"a", 1}}, json{{nullptr, 1}}, json("keys"), json(std::vector(17, json{1, 2}))}) {
        json one = node("k", "curve", {{"t", 0}});
        one["keys"] = keys;
        with(one, "/nodes/2/keys");
    }
    // Properties of fields, and what belongs to another stage.
    const auto property = [&](const std::string& type, json inputs, const std::string& name, const json& value,
                              const std::string& words) {
        json one = node("k", type, std::move(inputs));
        one[name] = value;
        with(one, words);
    };
    property("drag", {{"velocity", "v"}, {"k", 1}}, "seed", 1, "is no property of a node of type drag");
    property("noise", {{"at", "v"}}, "seed", 16777216, "/nodes/2/seed");
    property("noise", {{"at", "v"}}, "seed", 0.5, "/nodes/2/seed");
    property("noise", {{"at", "v"}}, "potential", 1, "is no property of a node of type noise");
    property("noise_gradient", {{"at", "v"}}, "potential", 4, "/nodes/2/potential");
    property("vortex", {{"position", "v"}, {"axis", "v"}}, "falloff", 3, "/nodes/2/falloff");
    property("vortex", {{"position", "v"}}, "falloff", 1, "has nothing at its port axis");
    property("point_attraction", {{"position", "v"}}, "law", "cubic", "/nodes/2/law");
    property("cone", {{"u", "v"}, {"direction", "v"}}, "angle", 3, "\"direction\" is missing");
    json cone = node("k", "cone", {{"u", "v"}});
    with(cone, "\"direction\" is missing");
    cone["direction"] = {0, 0, 0};
    cone["angle"] = 10;
    with(cone, "/nodes/2/direction: has no length");
    cone["direction"] = {0, 1, 0};
    cone["angle"] = 181;
    with(cone, "is not a number of degrees from 0 to 180");
    with({{"id", "k"}, {"type", "random"}}, "belongs to the stage emission, not to simulation");
    with(node("k", "point_attraction", {{"position", true}}), "right is a vec3");
    with(node("k", "curl_noise", {{"position", "v"}, {"strength", "v"}}), "right is a float");
    with(node("k", "sin_turns", {{"a", false}}), "right is a float or a vector");
    for (const json& other : {json(5), json(4294967296), json(-1), json("five"), json(1.5)}) {
        json graph = small;
        graph["stage"] = "emission";
        graph["nodes"] = {{{"id", "a"}, {"type", "random"}, {"channel", 5}},
                          {{"id", "b"}, {"type", "random"}, {"channel", other}}};
        graph["outputs"] = {{"lifetime", "a"}};
        add(graph, other == 5 ? "'b' has the numbers of 'a': channel 5 is that of both" : "/nodes/1/channel");
    }
    with(node("k", "compose", {{"x", 1}, {"y", 1}, {"w", 1}}), "nothing at its port z, and something at w");
    for (const char* const link : {"v.x", "parts", "parts.w", "parts.xy", "parts.", "parts.x.x", ".x", "."}) {
        json graph = small;
        graph["nodes"].push_back(node("parts", "split", {{"a", "v"}}));
        graph["nodes"].push_back(node("k", "negate", {{"a", link}}));
        add(graph, "/nodes/3/inputs/a");
    }
    // Too much.
    add(chain(65), "more than 64 nodes behind each other");
    add(chain(200), "more than 64 nodes behind each other");
    add(chain(255), "257 nodes; right is at most 256");
    add(chain(5000), "right is at most 256");
    // Other shapes than a graph's.
    for (const char* const text :
         {"[]", "3", "null", "\"graph\"", "{}", R"({"nodes": 3, "outputs": {}})", R"({"nodes": [], "outputs": {}})",
          R"({"nodes": [3], "outputs": {}})", R"({"nodes": [[]], "outputs": {}})", R"({"nodes": [{}], "outputs": {}})",
          R"({"nodes": [], "outputs": []})", R"({"nodes": [], "outputs": {"drag": "a"}})",
          R"({"nodes": [], "outputs": {"drag": []}})", R"({"nodes": [], "graph": 1})",
          R"({"stage": "death", "nodes": [], "outputs": {"drag": 1}})",
          R"({"stage": 3, "nodes": [], "outputs": {"drag": 1}})"})
        all.emplace_back(text, "graph.json: ");
    for (const char* const text :
         {"", "{", "[1,", "{\"nodes\": [", "nul", "{\"a\": 1, \"a\": 2}", "\xff\xfe", "{\"nodes\": 1e999}", "\"\n\""})
        all.emplace_back(text, "graph.json:");
    // Texts in the place of other texts.
    const std::string text = small.dump();
    const auto instead = [&](const std::string& of, const std::string& other, const std::string& words) {
        const std::size_t place = text.find(of);
        REQUIRE(place != std::string::npos);
        all.emplace_back(std::string(text).replace(place, of.size(), other), words);
    };
    for (const char* const number : {"NaN", "-Infinity", "1e400", "0x1p3", "01", "+1", ".5", "1.", "--1"})
        instead("-0.8", number, "malformed JSON");
    instead("-0.8", std::string(400, '9'), "number overflow");
    for (const char* const number : {"null", "{}"})
        instead("-0.8", number, "is not a finite number");
    instead("-0.8", "-1e39", "is beyond what a float holds, 3.4e38");
    for (const char* const numbers : {"[]", "[1]", "[1, 2, 3, 4, 5]", "[[1, 2, 3]]"})
        instead("-0.8", numbers, "right is two to four");
    instead("-0.8", "[1, \"v\", 2]", "/nodes/1/inputs/b/1");
    instead("-0.8", "true", "gets a bool");
    instead("-0.8", "\"-0.8\"", "'-0.8' is no node");
    for (const char* const id :
         {"\"v\\n\"", "\"v\\u0000\"", "\"v; } void x() {\"", "\"\\u001b[31m\"", "\"v.x\"", "\"\""})
        instead("\"id\":\"v\"", std::string("\"id\":") + id, "is no name of a node");
    instead("\"id\":\"v\"", "\"id\":\"" + std::string(100'000, 'v') + "\"", "is no name of a node");
    instead("\"id\":\"v\"", "\"id\":\"\\ud800\"", "surrogate");
    instead("\"id\":\"v\"", "\"id\":\"\xff\"", "ill-formed UTF-8");
    instead("\"id\":\"v\"", "\"id\":\"v\",\"id\":\"w\"", "stands twice");
    instead("\"nodes\":", "\"version\":99,\"nodes\":", "unknown key \"version\"");
    for (const char* const stage : {"1", "null", "[]", "\"Simulation\"", "\"simulation \""})
        instead("\"simulation\"", stage, "/stage");
    for (const std::string& around : {"// graph\n" + text, text + text, text + "x", text.substr(1), "'" + text + "'",
                                      text.substr(0, text.size() - 1), std::string("\x1f\x8b\0", 3) + text})
        all.emplace_back(around, "malformed JSON");
    for (const std::size_t depth : {100, 10'000, 300'000})
        all.emplace_back("{\"nodes\": " + std::string(depth, '[') + std::string(depth, ']') + "}", "64 deep");
    return all;
}

} // namespace

TEST_CASE("graphs: each of 350 broken ones is one line of error, with its place, and none a crash") {
    const auto all = broken_graphs();
    CHECK(all.size() >= 350);
    std::set<std::string> texts;
    for (const auto& [text, words] : all) {
        texts.insert(text);
        const std::string error = error_of(text);
        INFO(text.substr(0, 2000));
        CHECK_THAT(error, Contains(words) && Catch::StartsWith("graph.json:"));
        CHECK(error.find('\n') == std::string::npos);
        CHECK(error.size() < 600);
    }
    CHECK(texts.size() >= 350);
}

TEST_CASE("graphs: what is wrong ends the verb with status 2 and one line") {
    const test::TemporaryFolder folder;
    const auto all = broken_graphs();
    for (std::size_t i = 0; i < all.size(); i += 40) {
        const std::string file = folder.write("graph.json", all[i].first).string();
        INFO(all[i].first.substr(0, 500));
        CHECK_THAT(refusal(run_lockstep({"graph", i % 80 == 0 ? "check" : "glsl", file})), Contains(all[i].second));
    }
    CHECK_THAT(refusal(run_lockstep({"graph", "check", folder.path() / "none.json"})), Contains("none.json"));
    CHECK_THAT(refusal(run_lockstep({"graph", "eval", folder.path()})), Contains("cannot be read"));
}

TEST_CASE("graphs: more items than a dispatch has are refused by the largest number") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string file = folder.write("graph.json", small_graph().dump()).string();
    CHECK_THAT(refusal(run_lockstep({"graph", "check", file, "--items", "4194304", "--gl", test::software_gl()})),
               Contains("graph: 4194304 invocations along x are more than this context takes; expected at most "
                        "4194240, 65535 groups of 64"));
}

TEST_CASE("graphs: a whole graph is right, and what no output needs is checked, not compiled") {
    CHECK(error_of(small_graph()).empty());
    CHECK(error_of(shipped("fire")).empty());
    CHECK(error_of(shipped("fade")).empty());
    CHECK(error_of(chain(63)).empty());
    json graph = small_graph();
    graph["nodes"].push_back(node("unused", "negate", {{"a", "v"}}));
    const json document = graph;
    const Graph read = read_graph(JsonValue(document, "graph.json"));
    CHECK(read.order == std::vector<std::size_t>{0, 1});
    graph["nodes"][2]["inputs"]["a"] = "nobody";
    CHECK_THAT(error_of(graph), Contains("/nodes/2/inputs/a: 'nobody' is no node"));
}

TEST_CASE("graphs: a divisor that is 0 at some inputs alone is divided by") {
    const auto divided_by = [](json divisor) {
        json graph = small_graph();
        graph["nodes"].push_back(node("less", "less", {{"a", 1}, {"b", "speed"}}));
        graph["nodes"].push_back(node("speed", "length", {{"a", "v"}}));
        graph["nodes"].push_back(std::move(divisor));
        graph["nodes"].push_back(node("k", "divide", {{"a", "v"}, {"b", "d"}}));
        return error_of(graph);
    };
    CHECK(divided_by(node("d", "select", {{"condition", "less"}, {"a", 0}, {"b", 1}})).empty());
    CHECK(divided_by(node("d", "step", {{"edge", 100}, {"a", "speed"}})).empty());
    CHECK(divided_by(node("d", "smoothstep", {{"low", 0}, {"high", 1}, {"a", "speed"}})).empty());
    CHECK(divided_by(node("d", "noise", {{"at", "v"}})).empty());
    CHECK(divided_by(node("d", "max", {{"a", "speed"}, {"b", 0}})).empty());
    json bump = node("d", "curve", {{"t", "speed"}});
    bump["keys"] = {{0, 0}, {3, 0}, {3.5, 1}, {4, 0}};
    CHECK(divided_by(bump).empty());
}

TEST_CASE("graphs: the verb prints the shader and what each node makes") {
    const auto glsl = run_lockstep({"graph", "glsl", "data/graphs/fire.json"});
    CHECK(glsl.status == 0);
    CHECK_THAT(glsl.out, Contains("precise vec3") && Contains("// lift"));
    const auto eval = run_lockstep({"graph", "eval", "data/graphs/fire.json", "--item", "9"});
    CHECK(eval.status == 0);
    CHECK_THAT(eval.out, Contains("lift") && Contains("-> acceleration") && Contains("0x1."));
}

} // namespace lockstep::test::broken_graphs_test
