#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::explain_command_test {

using test::refusal;
using test::run_lockstep;

namespace {

struct Setting : test::SceneSetting {
    Setting() : SceneSetting("explain") {}
    [[nodiscard]] test::Outcome explain(const std::vector<std::string>& options) const {
        return run_lockstep(command(options));
    }
};

std::vector<std::string> words(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> result;
    std::string word;
    stream >> word;
    while (stream >> word)
        result.push_back(word);
    return result;
}

std::string after(const std::string& text, const std::string& mark) {
    const std::size_t start = text.find(mark);
    REQUIRE(start != std::string::npos);
    return text.substr(start + mark.size(), text.find('\n', start) - start - mark.size());
}

} // namespace

TEST_CASE("explain_command: a particle's table, from clip position to the texel's owner") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::Outcome outcome = setting.explain({"--frame", "2", "--particle", "17"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    std::size_t last = 0;
    for (const char* row : {"particle 17 in frame 2",
                            "step ",
                            "clip.x",
                            "clip / w.x",
                            "texture coordinate.x",
                            "image position.x",
                            "search",
                            "velocity.x",
                            "direction.x",
                            "speed",
                            "collide time",
                            "position.x",
                            "point's clip.x",
                            "gl_Position.x",
                            "window position.x",
                            "snapped.x",
                            "texel",
                            "depth",
                            "also wanted by",
                            "owner of texel",
                            "stored.x",
                            "every bit agrees"}) {
        const std::size_t place = outcome.out.find(row, last);
        INFO(row);
        CHECK(place != std::string::npos);
        last = place == std::string::npos ? last : place;
    }
    CHECK(setting.explain({"--frame", "2", "--particle", "17"}).out == outcome.out);
    CHECK_THAT(setting.explain({"--frame", "2", "--particle", "17", "--hex"}).out, Catch::Contains("0x1."));
}

TEST_CASE("explain_command: check's first divergence names the command that shows it again") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const auto check = [&] {
        return run_lockstep({"check", setting.scene, "--frames", "6", "--gl", test::software_gl(), "--shaders",
                             setting.shaders.path()});
    };
    CHECK_THAT(check().out, !Catch::Contains("again: "));
    SECTION("a particle") {
        test::plant(setting.shaders, "collision_pass.vert", "product(a_Speed, u_SpeedFactor)", "a_Speed");
        const std::string again = after(check().out, "again: ");
        CHECK_THAT(again, Catch::StartsWith("lockstep explain ") && Catch::Contains(" --particle "));
        const test::Outcome outcome = run_lockstep(words(again));
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains("first     speed: ") && Catch::Contains(": divergent\n"));
    }
    SECTION("a texel") {
        test::plant(setting.shaders, "collision_pass.frag", "encode_position(out_Position)",
                    "encode_position(out_Position + 0.5)");
        const std::string again = after(check().out, "again: ");
        CHECK_THAT(again, Catch::Contains(" --texel "));
        const test::Outcome outcome = run_lockstep(words(again));
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains("none that is known") && Catch::Contains("DIVERGENT"));
    }
}

TEST_CASE("explain_command: points at the shader's own line, with the shipped one's; of a rewrite at none") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::vector<std::string> place{"--frame", "2", "--particle", "17"};
    CHECK_THAT(setting.explain(place).out, !Catch::Contains("source "));
    test::plant(setting.shaders, "collision_pass.vert", "v_CollideTime = u_CollisionTime;", "v_CollideTime = 0.5;");
    const std::string text = setting.explain(place).out, file = setting.shaders.path() / "collision_pass.vert";
    CHECK_THAT(text,
               Catch::Contains("source    " + file + " differs from the shipped collision_pass.vert in 1 line:\n") &&
                   Catch::Contains("- v_CollideTime = u_CollisionTime;\n") &&
                   Catch::Contains("+ v_CollideTime = 0.5;\n"));
    std::ifstream stream(file);
    int line = 1;
    for (std::string read; std::getline(stream, read) && read.find("= 0.5;") == std::string::npos;)
        ++line;
    CHECK_THAT(text, Catch::Contains(file + ":" + std::to_string(line) + "\n"));

    std::ofstream(file, std::ios::app) << "// one\n// two\n// three\n// four\n// five\n// six\n// seven\n"
                                          "// eight\n// nine\n// ten\n// eleven\n// twelve\n";
    CHECK_THAT(setting.explain(place).out, Catch::Contains(": 13 lines are not those of the shipped"));
}

TEST_CASE("explain_command: what cannot be explained is told in one line") {
    const Setting setting;
    const std::vector<std::string> start{"explain", setting.scene};
    const auto told = [&](std::vector<std::string> options) {
        options.insert(options.begin(), start.begin(), start.end());
        return refusal(run_lockstep(options));
    };
    CHECK(told({"--particle", "1"}) ==
          "--frame F is missing: the frame, counted from 0 (lockstep explain --help says more)");
    CHECK(told({"--frame", "-1", "--particle", "1"}) ==
          "--frame: '-1' is not an integer from 0 to 100000000 (lockstep explain --help says more)");
    const std::string one = "explain: one of --particle I, --texel X,Y and --pixel X,Y is needed";
    CHECK(told({"--frame", "1"}) == one);
    const std::string two = "explain: --particle, --texel and --pixel do not go together; right is one of them";
    CHECK(told({"--frame", "1", "--particle", "1", "--texel", "1,1"}) == two);
    CHECK(told({"--frame", "1", "--pixel", "1,1", "--texel", "1,1"}) == two);
    CHECK(told({"--frame", "1", "--particle", "1", "--legal", "loose"}) ==
          "--legal: 'loose' is not one of by_text, measured, glsl, any_order (lockstep explain --help says more)");
    for (const char* wrong : {"300", "-1", "x", "1.5", ""})
        CHECK(told({"--frame", "1", "--particle", wrong}) ==
              "there is no particle '" + std::string(wrong) + "'; scene has 0 to 299");
    for (const char* wrong : {"64,0", "0,48", "-1,0", "3", "3,", ",3", "1,2,3", "a,b", "1, 2"})
        CHECK(told({"--frame", "1", "--texel", wrong}) ==
              "there is no texel '" + std::string(wrong) + "'; the CDT has 0,0 to 63,47");
    for (const char* wrong : {"40,0", "0,30", "-1,0", "3", "3,", ",3", "1,2,3", "a,b", "1, 2"})
        CHECK(told({"--frame", "1", "--pixel", wrong}) ==
              "there is no pixel '" + std::string(wrong) + "'; the rendered frame has 0,0 to 39,29");
    CHECK(refusal(run_lockstep({"explain", "--trace", "run.h5", "--frame", "1", "--pixel", "1,1"})) ==
          "explain: --pixel needs a scene, since a recording holds no picture; --particle and --texel go with one");
}

TEST_CASE("explain_command: a pixel of the rendered frame, with what is drawn there") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::Outcome empty = setting.explain({"--frame", "2", "--pixel", "0,0"});
    CHECK(empty.status == 0);
    CHECK(empty.err.empty());
    CHECK_THAT(empty.out, Catch::Contains("pixel (0, 0) in frame 2: every bit agrees") &&
                              Catch::Contains("the background") && Catch::Contains("beside it: particle "));
    CHECK_THAT(setting.explain({"--frame", "2", "--pixel", "39,29", "--hex"}).out, Catch::Contains("depth 0x1p+0"));
}

TEST_CASE("explain_command: check names the command of the rendered frame's first divergent pixel, and it the cause") {
    if (!test::have_software_gl())
        return;
    Setting setting;
    std::string large = test::small_scene;
    large.replace(large.find("\"collision_range\""), 0, "\"billboard_radius\": 0.06, ");
    setting.folder.write("scene.json", large);
    const auto cause = [&] {
        const test::Outcome check = run_lockstep({"check", setting.scene, "--frames", "3", "--gl", test::software_gl(),
                                                  "--shaders", setting.shaders.path()});
        CHECK(check.status == 1);
        const std::string again = after(check.out, "again: ");
        CHECK_THAT(again, Catch::Contains(" --frame 2 --pixel "));
        const test::Outcome outcome = run_lockstep(words(again));
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains(" in frame 2: divergent\n"));
        return after(outcome.out, "cause     ");
    };
    SECTION("squares of half the size") {
        test::plant(setting.shaders, "render_pass.geom", "gl_Position = vec4((i & 1) == 0 ? low.x : high.x,",
                    "vec2 q = (high.xy - low.xy) * 0.25; if (i == 0) { low.xy += q; high.xy -= q; }\n"
                    "gl_Position = vec4((i & 1) == 0 ? low.x : high.x,");
        CHECK_THAT(cause(), Catch::StartsWith("quads_half_size: ") && Catch::EndsWith(", as the GPU does"));
    }
    SECTION("nothing emitted") {
        test::plant(setting.shaders, "render_pass.geom", "EmitVertex();", "");
        CHECK_THAT(cause(), Catch::StartsWith("sprites_not_drawn: "));
    }
    SECTION("the depth of the sphere's centre") {
        test::plant(setting.shaders, "render_pass.frag", "g_Centre.z + normal.z * u_BillboardRadius", "g_Centre.z");
        CHECK_THAT(cause(), Catch::StartsWith("sphere_is_flat_in_depth: "));
    }
}

TEST_CASE("explain_command: a step of the octree, and one with remedies, value by value along its twin") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const char* search : {"search=octree", "cdt_layers=2"}) {
        INFO(search);
        const test::Outcome outcome = setting.explain({"--frame", "1", "--particle", "1", "--set", search});
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains(" same\n") &&
                                    Catch::Contains("particle 1 in frame 1: every bit agrees") &&
                                    Catch::Contains("legal outcome 1 of 1, the GPU is in it"));
    }
    CHECK_THAT(setting.explain({"--frame", "1", "--texel", "3,4", "--set", "cdt_layers=2"}).out,
               Catch::Contains("texel (3, 4) in frame 1: every bit agrees"));
}

TEST_CASE("explain_command: a trace build that does not compile is told with file and line") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "void start_trace() {", "void start_trace() { nonsense;");
    const test::Outcome outcome = setting.explain({"--frame", "0", "--particle", "1"});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err,
               Catch::StartsWith("lockstep: shader " + (setting.shaders.path() / "collision_pass.vert:").string()) &&
                   Catch::Contains("nonsense"));
    CHECK(run_lockstep({"check", setting.scene, "--frames", "2", "--gl", test::software_gl(), "--shaders",
                        setting.shaders.path()})
              .status == 0);
}

} // namespace lockstep::test::explain_command_test
