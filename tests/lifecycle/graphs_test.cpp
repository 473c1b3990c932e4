#include <array>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/lifecycle/picture.hpp"
#include "crosscheck/lifecycle/scene.hpp"
#include "crosscheck/scene/graph_file.hpp"
#include "gpu/lifecycle/graphs.hpp"
#include "reference/model/error.hpp"
#include "reference/model/lifecycle/drawing.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::graphs_test {

using Catch::Contains;
namespace lifecycle = lockstep::lifecycle;
namespace counter = lifecycle::counter;

namespace {

GraphPtr shipped(const std::string& name) {
    return std::make_shared<const Graph>(load_graph("data/graphs/" + name + ".json"));
}

GraphPtr graph_of(const std::string& stage, const std::string& text) {
    const nlohmann::json document = nlohmann::json::parse(text);
    return std::make_shared<const Graph>(read_graph(JsonValue(document, "graph.json"), stage));
}

lifecycle::Settings small() {
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 700;
    e.rate = 900.0;
    e.lifetime = {0.1F, 0.3F};
    e.acceleration = {0.5F, -9.8F, 0.25F};
    e.size = {0.1F, 0.03F};
    e.color = {glm::vec4(0.6F, 0.81F, 1.0F, 0.9F), glm::vec4(0.2F, 0.4F, 0.77F, 0.1F)};
    return s;
}

lifecycle::Settings with_graphs() {
    lifecycle::Settings s = small();
    lifecycle::Emitter& e = s.emitters.front();
    e.lifetime = {0.2F, 0.4F};
    e.emission = shipped("spray");
    e.simulation = shipped("fire");
    e.rendering = shipped("fade");
    return s;
}

/// The state that the reference has after some frames, of a run in exact.
SystemState after(const lifecycle::Settings& settings, int frames) {
    const lifecycle::HostPtr host = host_of(settings);
    const System system = lifecycle::system(host);
    ReferenceRun run = reference_of(system);
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return run.state();
}

std::uint64_t hash_after(const lifecycle::Settings& settings, int frames) {
    const System system = lifecycle::system(host_of(settings));
    ReferenceRun run = reference_of(system);
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return run.hash();
}

std::uint32_t count_of(const SystemState& state, std::uint8_t word) {
    return state.view().word({lifecycle::counter_buffer, word}, 0);
}

/// The causes that explain everything.
std::set<std::string> causes_of(const CheckReport& report) {
    std::set<std::string> names;
    if (report.verdicts)
        for (const CauseFindings& found : report.verdicts->causes)
            for (const Cause& cause : found.best)
                if (found.explains_all())
                    names.insert(cause.name());
    return names;
}

/// A run in which a text of a stage's graph is compiled wrongly.
CheckReport run_with(const lifecycle::Settings& settings, const std::string& file, const std::string& what,
                     const std::string& by) {
    const lifecycle::HostPtr host = host_of(settings);
    std::vector<GlPass> passes = lifecycle::passes(host);
    for (GlPass& pass : passes)
        if (const auto text = pass.texts.find(file); text != pass.texts.end()) {
            const std::size_t at = text->second.find(what);
            REQUIRE(at != std::string::npos);
            text->second.replace(at, what.size(), by);
        }
    return run_system(lifecycle::system(host), passes, "shaders/lifecycle", settings.arithmetic, 12, CheckMode::resync);
}

} // namespace

TEST_CASE("emitters' graphs: birth and step agree with their interpreter, from every layout") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = with_graphs();
    const int layout = GENERATE(0, 2, 3, 6);
    s.switches.layout = static_cast<lifecycle::Layout>(layout);
    s.switches.drag = layout == 2 ? lifecycle::Drag::explicit_force : lifecycle::Drag::implicit;
    s.switches.fuse = layout == 3 ? lifecycle::Fuse::split : lifecycle::Fuse::fused;
    const CheckReport exact = run_lifecycle(in_exact(s), 30, CheckMode::free);
    INFO(report_text(exact, {}));
    CHECK(exact.verdict == Verdict::agree);
    const CheckReport plain = run_lifecycle(s, 12);
    INFO(report_text(plain, {}));
    CHECK((plain.verdict == Verdict::agree || plain.verdict == Verdict::legal));
}

TEST_CASE("emitters' graphs: in lists, in a box and where emission comes first, too") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = with_graphs();
    const int which = GENERATE(0, 1, 2);
    if (which == 0) {
        s.switches.management = lifecycle::Management::index_lists;
        s.switches.uv_anchor = lifecycle::UvAnchor::oldest;
    } else if (which == 1) {
        s.switches.position_code = lifecycle::PositionCode::box16;
        s.box_low = {-0.2F, -0.2F, -0.2F};
        s.box_size = {0.4F, 0.4F, 0.4F};
    } else {
        s.switches.emit_when = lifecycle::EmitWhen::before_destroy;
    }
    const CheckReport report = run_lifecycle(in_exact(s), 30, CheckMode::free);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
    if (which == 1)
        CHECK(count_of(after(in_exact(s), 30), counter::clamped) > 0);
}

TEST_CASE("emitters' graphs: those that say what happens without one change no bit") {
    for (const auto layout : {lifecycle::Layout::bytes_112, lifecycle::Layout::bytes_40}) {
        lifecycle::Settings s = in_exact(small());
        s.switches.layout = layout;
        s.emitters.front().direction_jitter = 0.25F;
        const std::uint64_t without = hash_after(s, 25);
        s.emitters.front().simulation = shipped("simulation");
        CHECK(hash_after(s, 25) == without);
        s.emitters.front().emission = shipped("emission");
        CHECK(hash_after(s, 25) == without);
        s.emitters.front().emission = shipped("spray");
        CHECK(hash_after(s, 25) != without);
    }
}

TEST_CASE("emitters' graphs: what one compiles wrongly is found, and named by its node") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = in_exact(with_graphs());
    s.switches.layout = lifecycle::Layout::bytes_112;
    for (const auto& [file, what, by, cause] : std::vector<std::array<std::string, 4>>{
             {"simulation_graph.glsl", "precise vec3 n12 = ", "precise vec3 n12 = 2.0 * ", "node sum: doubled"},
             {"simulation_graph.glsl", "m.acceleration = n13;", "m.acceleration = -n13;", "acceleration_reversed"},
             {"emission_graph.glsl", "precise float n7 = ", "precise float n7 = 2.0 * ", "node speed: doubled"},
             {"emission_graph.glsl", "precise vec3 n12 = ", "precise vec3 n12 = 0.0 * ", "born_still"}}) {
        const CheckReport report = run_with(s, file, what, by);
        INFO(what << report_text(report, {}));
        CHECK(report.verdict == Verdict::divergent);
        CHECK(causes_of(report).contains(cause));
    }
    CHECK(run_with(s, "emission_graph.glsl", "i_emitter_position = u_Origin", "i_emitter_position = u_Direction")
              .verdict == Verdict::divergent);
    CHECK(run_with(s, "simulation_graph.glsl", "i_t = age()", "i_t = 1.0 - age()").verdict == Verdict::divergent);
}

TEST_CASE("emitters' graphs: who is killed dies in the next frame, and is counted") {
    lifecycle::Settings s = in_exact(small());
    s.emitters.front().simulation = graph_of("simulation", R"({"nodes": [
        {"id": "p", "type": "input", "value": "position"}, {"id": "xyz", "type": "split", "inputs": {"a": "p"}},
        {"id": "low", "type": "less", "inputs": {"a": "xyz.y", "b": 0.05}}], "outputs": {"kill": "low"}})");
    const SystemState state = after(s, 25);
    CHECK(count_of(state, counter::killed) > 100);
    CHECK(count_of(state, counter::alive) < 200);
    if (!gl())
        return skip(gl().missing());
    CHECK(run_lifecycle(s, 25, CheckMode::free).verdict == Verdict::agree);
}

TEST_CASE("emitters' graphs: a lifetime stays within the emitter's, whatever a graph makes of it, NaN too") {
    if (!gl())
        return skip(gl().missing());
    for (const char* const life : {"-1", "1e30", "\"nan\""}) {
        lifecycle::Settings s = in_exact(small());
        s.emitters.front().emission =
            graph_of("emission", std::string(R"({"nodes": [{"id": "time", "type": "input", "value": "time"},
                                           {"id": "zero", "type": "subtract", "inputs": {"a": "time", "b": "time"}},
                                           {"id": "nan", "type": "divide", "inputs": {"a": 0, "b": "zero"}}],
                                 "outputs": {"lifetime": )") +
                                     life + "}}");
        INFO(life);
        CHECK(run_lifecycle(s, 40, CheckMode::free).verdict == Verdict::agree);
        const SystemState state = after(s, 40);
        // 15 a frame, for 0.1 s or 0.3 s and the frame in which they are seen dead.
        CHECK(count_of(state, counter::alive) == (std::string(life) == "1e30" ? 19U : 7U) * 15U);
    }
}

TEST_CASE("emitters' graphs: velocity and position in place of the integrator's, and a drag of the graph's own") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = in_exact(small());
    s.switches.layout = lifecycle::Layout::bytes_112;
    for (const char* const outputs :
         {R"({"position": "p"})", R"({"velocity": [0, 0.5, 0]})", R"({"position": [1, 2, 3], "velocity": "p"})",
          R"({"drag": "k"})", R"({"drag": "k", "acceleration": 0, "kill": false})"}) {
        s.emitters.front().simulation = graph_of("simulation", std::string(R"({"nodes": [
            {"id": "p", "type": "input", "value": "position"}, {"id": "k", "type": "parameter", "value": 3.5}],
            "outputs": )") + outputs + "}");
        INFO(outputs);
        CHECK(run_lifecycle(s, 15, CheckMode::free).verdict == Verdict::agree);
    }
}

TEST_CASE("emitters' graphs: size and colour of what is drawn, of two emitters with and one without") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = small();
    s.switches.layout =
        GENERATE(lifecycle::Layout::bytes_112, lifecycle::Layout::bytes_72, lifecycle::Layout::bytes_40);
    s.emitters.push_back(s.emitters.front());
    s.emitters.push_back(s.emitters.front());
    s.emitters[0].rendering = shipped("fade");
    s.emitters[2].rendering = graph_of("rendering", R"({"nodes": [
        {"id": "u", "type": "input", "value": "u"}, {"id": "v", "type": "input", "value": "v"},
        {"id": "born", "type": "input", "value": "spawn_time"}, {"id": "speed", "type": "input", "value": "velocity"},
        {"id": "fall", "type": "input", "value": "acceleration"}, {"id": "time", "type": "input", "value": "time"},
        {"id": "left", "type": "input", "value": "remaining"}, {"id": "l", "type": "length", "inputs": {"a": "speed"}},
        {"id": "f", "type": "length", "inputs": {"a": "fall"}}, {"id": "age", "type": "subtract", "inputs": {"a": "time", "b": "born"}},
        {"id": "sum", "type": "add", "inputs": {"a": "f", "b": "left"}},
        {"id": "tint", "type": "compose", "inputs": {"x": "u", "y": "v", "z": "l", "w": "sum"}}],
        "outputs": {"color": "tint", "size": "age"}})");
    for (const auto arithmetic : {ArithmeticSwitch::exact, ArithmeticSwitch::plain}) {
        s.arithmetic = arithmetic;
        const lifecycle::HostPtr host = host_of(s);
        const SystemPicture picture = lifecycle::picture(host, after(s, 20), 19);
        GlSystemSide side(gl(), picture.system, picture.passes, "shaders/lifecycle", s.arithmetic);
        CheckOptions options;
        options.frames = 1;
        const CheckReport report = check(picture.system, side, options);
        INFO(report_text(report, {}));
        CHECK((report.verdict == Verdict::agree ||
               (arithmetic == ArithmeticSwitch::plain && report.verdict == Verdict::legal)));
    }
}

TEST_CASE("emitters' graphs: a built-in look written as a graph changes no corner") {
    lifecycle::Settings s = in_exact(small());
    const auto corners = [&] {
        const lifecycle::HostPtr host = host_of(s);
        const SystemPicture picture = lifecycle::picture(host, after(s, 20), 19);
        ReferenceRun run = reference_of(picture.system);
        run.step(0);
        return run.hash();
    };
    const std::uint64_t without = corners();
    s.emitters.front().rendering = shipped("rendering");
    CHECK(corners() == without);
    s.emitters.front().rendering = shipped("fade");
    CHECK(corners() != without);
}

TEST_CASE("emitters' graphs: what is wrong is told with the graph's file and place") {
    const auto error_of = [](const std::string& graphs) -> std::string {
        const nlohmann::json scene =
            nlohmann::json::parse(R"({"system": "lifecycle", "emitters": [{"graphs": )" + graphs + "}]}");
        try {
            static_cast<void>(lifecycle::read_scene(JsonValue(scene, "data/scenes/lifecycle/scene.json"), {}));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(error_of(R"({"simulation": "../../graphs/fire.json"})").empty());
    CHECK_THAT(error_of(R"({"simulation": "../../graphs/fade.json"})"),
               Contains("fade.json: /stage: is rendering; right is simulation"));
    CHECK_THAT(error_of(R"({"simulation": "nothing.json"})"), Contains("nothing.json"));
    CHECK_THAT(error_of(R"({"death": "fire.json"})"), Contains("/emitters/0/graphs"));
    CHECK_THAT(error_of(R"({"simulation": 3})"), Contains("/emitters/0/graphs/simulation"));
    CHECK_THAT(error_of(R"({"simulation": {"nodes": [{"id": "a", "type": "negate", "inputs": {"a": "a"}}],
                                           "outputs": {"drag": "a"}}})"),
               Contains("/emitters/0/graphs/simulation/nodes/0: the nodes wait for each other: a needs a"));
    CHECK_THAT(error_of(R"({"emission": {"nodes": [], "outputs": {"drag": 1}}})"),
               Contains("'drag' is an output of the stage simulation, not of emission"));
    // What fits no switch or emitter.
    lifecycle::Settings s = small();
    s.emitters.front().simulation = graph_of("simulation", R"({"nodes": [], "outputs": {"drag": 1}})");
    s.switches.drag = lifecycle::Drag::exponential;
    CHECK_THROWS_WITH(host_of(s), Contains("right is implicit or explicit"));
    s = small();
    s.emitters.front().draw = lifecycle::Emitter::Draw::ribbon;
    s.emitters.front().rendering = shipped("fade");
    CHECK_THROWS_WITH(host_of(s), Contains("of a ribbon right is color alone"));
    s.switches.layout = lifecycle::Layout::bytes_112;
    s.emitters.front().rendering = graph_of("rendering", R"({"nodes": [
        {"id": "v", "type": "input", "value": "velocity"}, {"id": "a", "type": "input", "value": "acceleration"},
        {"id": "s", "type": "dot", "inputs": {"a": "a", "b": "v"}}], "outputs": {"color": "s"}})");
    CHECK_THROWS_WITH(host_of(s), Contains("more than 16 attributes with ribbons"));
}

} // namespace lockstep::test::graphs_test
