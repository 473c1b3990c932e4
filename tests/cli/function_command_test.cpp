#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"

namespace lockstep::test::function_command_test {

using Catch::Contains;

namespace {

const std::string wall = "uniform float u_Kept;\n"
                         "vec3 bounce(vec3 velocity, const in vec3 n) {\n"
                         "    precise float into = velocity.x * n.x + (velocity.y * n.y + velocity.z * n.z);\n"
                         "    precise vec3 left = velocity - n * (into * (1.0 + u_Kept));\n"
                         "    return left;\n"
                         "}\n";

/// What the function returns of walls that axes are normal to: every operation is exact.
const std::string walls = "velocity.x,velocity.y,velocity.z,n.x,n.y,n.z,result.x,result.y,result.z\n"
                          "1, -2, 0, 0, 1, 0, 1, 1, 0\n"
                          "# from above\n"
                          "3, -4, 0.5, 0, 1, 0, 3, 2, 0.5\n"
                          "0x1.8p1, 0, -8, 0, 0, 1, 3, 0, 4\n";

/// A shader, a table, and the verb on both.
struct Setting {
    TemporaryFolder folder;
    std::string shader = folder.write("wall.glsl", wall).string();

    [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
        return folder.write(name, text).string();
    }
    [[nodiscard]] std::vector<std::string> command(const std::string& table,
                                                   const std::vector<std::string>& more = {}) const {
        return joined(
            {"function", shader, "bounce", "--table", table, "--uniform", "u_Kept=0.5", "--gl", software_gl()}, more);
    }
    [[nodiscard]] Outcome run(const std::string& table, const std::vector<std::string>& more = {}) const {
        return run_lockstep(command(table, more));
    }
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

} // namespace

TEST_CASE("function: the results of a table agree, from CSV and from JSON") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const Outcome csv = setting.run(setting.file("walls.csv", walls));
    INFO(csv.out << csv.err);
    CHECK(csv.status == 0);
    CHECK_THAT(csv.out, Contains("verdict   AGREE: every bit of 3 rows"));
    const Outcome json =
        setting.run(setting.file("walls.json", R"([{"velocity": [1, -2, 0], "n": [0, 1, 0], "result": [1, 1, 0]},
                          {"n": [0, 0, 1], "result": [3, 0, "0x1p2"], "velocity": ["3", 0, -8]}])"));
    INFO(json.out << json.err);
    CHECK(json.status == 0);
    CHECK_THAT(json.out, Contains("verdict   AGREE: every bit of 2 rows"));
}

TEST_CASE("function: a wrong result is told with its row, its line and its arguments, and repeated") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string table = setting.file("walls.csv", replaced(walls, "3, 2, 0.5", "3, 2.0000002, 0.5"));
    const std::string report = (setting.folder.path() / "report.json").string();
    const Outcome outcome = setting.run(table, {"--json", report});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("verdict   DIVERGENT"));
    CHECK_THAT(outcome.out, Contains("walls.csv:4): velocity (3") && Contains("-4"));
    CHECK_THAT(outcome.out, Contains("step function, result") && Contains("1 ULP outside"));
    CHECK_THAT(outcome.out, Contains(fmt::format("repeat    lockstep function {} bounce --table {} --uniform "
                                                 "u_Kept=0.5 --gl {}",
                                                 setting.shader, table, software_gl())));
    std::ifstream stream(report);
    CHECK(nlohmann::json::parse(stream).at("verdict") == "DIVERGENT");
    const Outcome quiet = setting.run(table, {"--quiet"});
    CHECK(quiet.status == 1);
    CHECK(quiet.out.empty());
}

TEST_CASE("function: another shader's function gives the results") {
    if (!have_software_gl())
        return;
    const Setting setting;
    std::string rows = "n.x,n.y,n.z,velocity.x,velocity.y,velocity.z\n";
    for (int i = 0; i < 200; ++i)
        rows += fmt::format("{},{},{},{},{},{}\n", std::sin(i), std::cos(i), 0.3, std::sin(7 * i), std::cos(3 * i),
                            std::sin(2 * i));
    const std::string table = setting.file("rows.csv", rows);
    const std::string same = setting.file(
        "same.vert", "#version 400 core\n" +
                         replaced(replaced(wall, "bounce(", "reflected("), "uniform float", "uniform highp float") +
                         "void main() { gl_Position = vec4(0.0); }\n");
    const Outcome agrees = setting.run(table, {"--like", same, "--like-name", "reflected"});
    INFO(agrees.out << agrees.err);
    CHECK(agrees.status == 0);
    CHECK_THAT(agrees.out, Contains("AGREE: every bit of 200 rows") && Contains("results of reflected ("));
    const std::string other =
        setting.file("other.glsl", replaced(wall, "velocity.x * n.x + (velocity.y * n.y + velocity.z * n.z)",
                                            "(velocity.x * n.x + velocity.y * n.y) + velocity.z * n.z"));
    const Outcome differs = setting.run(table, {"--like", other});
    INFO(differs.out << differs.err);
    CHECK(differs.status == 1);
    CHECK_THAT(differs.out, Contains("DIVERGENT") && Contains("rows.csv:"));
}

TEST_CASE("function: integers, single numbers, infinities and NaN") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("more.glsl", "uniform ivec2 u_Size;\nuniform mat4 u_Turn;\n"
                                                         "int texel(vec2 at, int row) { return int(at.x) + u_Size.x * "
                                                         "(row + u_Size.y); }\n"
                                                         "float kept(float x) { return x; }\n"
                                                         "vec4 turned(vec4 v) { return u_Turn[1] + v * 0.0; }\n");
    const auto run = [&](const std::string& name, const std::string& rows, const std::vector<std::string>& more) {
        return run_lockstep(joined(
            {"function", shader, name, "--table", setting.file(name + ".csv", rows), "--gl", software_gl()}, more));
    };
    const std::string texels = "row,at.x,at.y,result\n2,1.5,0,701\n-3,7,0,-793\n";
    const Outcome texel = run("texel", texels, {"--uniform", "u_Size=100,5"});
    INFO(texel.out << texel.err);
    CHECK(texel.status == 1); // 1 + 100 * (2 + 5) is 701, 7 + 100 * (-3 + 5) is 207
    CHECK_THAT(texel.out, Contains("texel.csv:3): at (7") && Contains("207"));
    CHECK(run("texel", replaced(texels, "-793", "207"), {"--uniform", "u_Size=100,5"}).status == 0);
    CHECK(run("kept", "x,result\ninf,inf\n-inf,-INF\nnan,nan\n-0,0\n3.4e38,3.4e38\n", {}).status == 0);
    CHECK(run("kept", "x,result\ninf,nan\n", {}).status == 1);
    CHECK(run("turned", "v.x,v.y,v.z,v.w,result.x,result.y,result.z,result.w\n1,2,3,4,5,6,7,8\n",
              {"--uniform", "u_Turn=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16"})
              .status == 0);
}

TEST_CASE("function: what cannot be run is one line that says what would be right") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const auto of_table = [&](const std::string& text, const std::string& name = "walls.csv") {
        return refusal(setting.run(setting.file(name, text)));
    };
    CHECK_THAT(of_table(replaced(walls, "velocity.y", "velocty.y")),
               Contains("walls.csv:1: column velocty.y is none of vec3 bounce(vec3, vec3)'s; right is velocity.x, ") &&
                   Contains("did you mean velocity.y?"));
    CHECK_THAT(of_table(replaced(walls, "n.z,", "n.x,")), Contains("walls.csv:1: column n.x stands there twice"));
    CHECK_THAT(of_table("velocity.x,velocity.y,velocity.z,n.x,n.y\n1,2,3,4,5\n"),
               Contains("walls.csv:1: column n.z is missing"));
    CHECK_THAT(of_table("velocity.x,velocity.y,velocity.z,n.x,n.y,n.z,result.x\n1,2,3,4,5,6,7\n"),
               Contains("walls.csv:1: column result.y is missing"));
    CHECK_THAT(of_table(replaced(walls, ", 2, 0.5", ", 2")), Contains("walls.csv:4: 8 values for 9 columns"));
    CHECK_THAT(of_table(replaced(walls, "-4", "-4.0.0")),
               Contains("walls.csv:4: column velocity.y: '-4.0.0' is no float; right is 0.25"));
    CHECK_THAT(of_table("velocity.x\n"), Contains("walls.csv: it has no rows; right is"));
    CHECK_THAT(of_table(R"([{"velocity": [1, 2], "n": [1, 2, 3], "result": [1, 2, 3]}])", "walls.json"),
               Contains("walls.json: /0/velocity: velocity is a vec3; right is an array of 3 numbers"));
    CHECK_THAT(of_table(R"([{"velocity": [1, 2, 3], "m": [1, 2, 3], "result": [1, 2, 3]}])", "walls.json"),
               Contains("walls.json: /0: unknown key \"m\"; the keys here are velocity, n, result"));
    CHECK_THAT(of_table(R"([{"velocity": [1, 2, 3], "n": [1, 2, 3], "result": [1, 2, 3]},
                            {"velocity": [1, 2, 3], "n": [1, 2, 3]}])",
                        "walls.json"),
               Contains("walls.json: /1: result is in some rows and not in others"));
    CHECK_THAT(of_table("[]", "walls.json"), Contains("walls.json: /: it has no rows"));

    const std::string table = setting.file("walls.csv", walls);
    const auto of_options = [&](const std::vector<std::string>& options) {
        return refusal(run_lockstep(joined({"function"}, options)));
    };
    CHECK_THAT(of_options({setting.shader, "bounse", "--table", table}), Contains("did you mean bounce?"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", table, "--uniform", "u_Kep=1"}),
               Contains("--uniform u_Kep=1:") && Contains("declares no uniform u_Kep; did you mean u_Kept?"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", table, "--uniform", "u_Kept=1,2"}),
               Contains("'1,2' is no float; right is NAME=NUMBER"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", table, "--gl", software_gl()}),
               Contains("nothing is given for uniform u_Kept"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", table, "--like", setting.shader}),
               Contains("has results, and --like gives others"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", table, "--like-name", "other"}),
               Contains("--like-name goes with --like"));
    CHECK_THAT(of_options({setting.shader, "bounce", "--table", "nothing.csv", "--uniform", "u_Kept=1"}),
               Contains("nothing.csv"));
    const std::string cut = of_options(
        {setting.shader, "bounce", "--table", table, "--uniform", "u_Kept=" + std::string(20'000, '9') + "x"});
    CHECK_THAT(cut, Contains("--uniform u_Kept=99") && Contains("99 ... 99") && Contains("is no float; right is NAME"));
    CHECK(cut.size() < 2000);
}

TEST_CASE("function: what a file leaves open is an error of that file, at its last line") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const auto of_text = [&](const std::string& text) {
        return refusal(run_lockstep({"function", setting.file("open.glsl", text), "kept", "--table",
                                     setting.file("kept.csv", "a, result\n1, 1\n"), "--gl", software_gl()}));
    };
    CHECK_THAT(of_text("float kept(float a) {\n    return a;\n"), Contains("shader open.glsl:2: syntax error"));
    CHECK_THAT(of_text("float kept(float a) { return a; }\n\n/* and so on"), Contains("shader open.glsl:3: "));
    CHECK_THAT(of_text("float kept(float a) { return a > 0.0 ? kept(a - 1.0) : a; }\n"),
               Contains("shader open.glsl: ") && Contains("static recursion"));
}

TEST_CASE("function: tables of integers without sign and of truths, in decimals and hexadecimal") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("words.glsl", "uint twice(uint x) { return x * 2u; }\n"
                                                          "bool odd(uvec2 x) { return (x.x & 1u) == x.y; }\n");
    const auto run = [&](const std::string& name, const std::string& table) {
        return run_lockstep({"function", shader, name, "--table", table, "--gl", software_gl()});
    };
    const std::string csv = setting.file("twice.csv", "x, result\n7, 14\n0x80000001, 2\n4294967295, 0xfffffffe\n");
    CHECK_THAT(run("twice", csv).out, Contains("AGREE: every bit of 3 rows"));
    const std::string json = setting.file("odd.json", R"([{"x": [3, 1], "result": true}, {"x": [2, 1], "result": 0}])");
    CHECK_THAT(run("odd", json).out, Contains("AGREE: every bit of 2 rows"));
    const Outcome wrong = run("twice", setting.file("wrong.csv", "x, result\n3000000000, 1705032705\n"));
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("reference 1705032705, GPU 1705032704") && Contains("off by 1"));
    const auto refused = [&](const std::string& name, const std::string& text) {
        return refusal(run(name, setting.file("refused.csv", text)));
    };
    CHECK_THAT(refused("twice", "x, result\n-1, 0\n"), Contains("'-1' is no uint; right is 7 or 0x7, to 4294967295"));
    CHECK_THAT(refused("twice", "x, result\n1, 4294967296\n"), Contains("'4294967296' is no uint"));
    CHECK_THAT(refused("odd", "x.x, x.y, result\n1, 1, 2\n"), Contains("'2' is no bool; right is 0 or 1"));
    CHECK_THAT(refusal(run("odd", setting.file("three.json", R"([{"x": [3, 1, 2], "result": true}])"))),
               Contains("three.json: /0/x: x is a uvec2; right is an array of 2 numbers"));
}

TEST_CASE("function: a macro needs a name") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string table = setting.file("walls.csv", walls);
    for (const char* const define : {"=4.0", "2K=1", "K-2=1", "K (x)=1"}) {
        CHECK_THAT(refusal(setting.run(table, {"--define", define})),
                   Contains("is no name of a macro; expected NAME=TEXT"));
    }
}

TEST_CASE("function: a uniform of integers keeps every bit, and is read as a table's number is") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader =
        setting.file("whole.glsl", "uniform int u_N;\nuniform uint u_U;\nuniform ivec2 u_V;\nuniform float u_F;\n"
                                   "int plus(int x) { return x + u_N; }\n"
                                   "uint plus_u(uint x) { return x + u_U; }\n"
                                   "int plus_v(int x) { return x + u_V.x - u_V.y; }\n"
                                   "float scaled(float x) { return x * u_F; }\n");
    const auto run = [&](const std::string& name, const std::string& rows, const std::string& uniform) {
        return run_lockstep({"function", shader, name, "--table", setting.file(name + ".csv", "x, result\n" + rows),
                             "--uniform", uniform, "--gl", software_gl()});
    };
    CHECK(run("plus", "0, 16777217\n", "u_N=16777217").status == 0);
    CHECK(run("plus", "0, 16777216\n", "u_N=16777217").status == 1);
    CHECK(run("plus", "0, -2147483648\n", "u_N=-2147483648").status == 0);
    CHECK(run("plus_u", "0, 4294967295\n", "u_U=4294967295").status == 0);
    CHECK(run("plus_u", "0, 255\n", "u_U=0xff").status == 0);
    CHECK(run("plus_v", "0, -3\n", "u_V=33554433,33554436").status == 0);
    CHECK(run("scaled", "8, 1\n", "u_F=0x1p-3").status == 0);
    CHECK(run("scaled", "1, 1.0000001192092896\n", "u_F=1.00000005960464477539062500001").status == 0);
    CHECK_THAT(refusal(run("plus", "0, 0\n", "u_N=2147483648")), Contains("'2147483648' is no int; right is"));
    CHECK_THAT(refusal(run("plus", "0, 0\n", "u_N=0.5")), Contains("'0.5' is no int; right is NAME=NUMBER"));
}

TEST_CASE("function: a row of JSON is rounded once, too") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("same.glsl", "float same(float x) { return x; }\n");
    for (const char* const row : {R"({"x": 1.00000005960464477539062500001, "result": 1.0000001192092896})",
                                  R"({"x": 9007199791611905, "result": 9007200328482816})",
                                  R"({"x": 3.4028234663852886e38, "result": "0x1.fffffep127"})"}) {
        const Outcome outcome =
            run_lockstep({"function", shader, "same", "--table",
                          setting.file("rows.json", "[" + std::string(row) + "]"), "--gl", software_gl()});
        INFO(outcome.out << outcome.err);
        CHECK(outcome.status == 0);
    }
}

TEST_CASE("function: a row that expects a subnormal is not met by 0") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("zero.glsl", "float zero(float x) { return 0.0; }\n"
                                                         "vec2 zeros(float x) { return vec2(0.0); }\n");
    for (const char* const expected : {"1e-40", "1.1754942e-38", "-1e-39", "1e-45"}) {
        INFO(expected);
        const auto run = [&](const std::string& name, const std::string& rows) {
            return run_lockstep(
                {"function", shader, name, "--table", setting.file("rows.csv", rows), "--gl", software_gl()});
        };
        const Outcome one = run("zero", fmt::format("x, result\n1, {}\n", expected));
        CHECK(one.status == 1);
        CHECK_THAT(one.out, Contains("DIVERGENT"));
        CHECK(run("zeros", fmt::format("x, result.x, result.y\n1, 0, {}\n", expected)).status == 1);
    }
}

TEST_CASE("function: one that is compared with itself is refused") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string table = setting.file("rows.csv", "velocity.x,velocity.y,velocity.z,n.x,n.y,n.z\n1,-2,0,0,1,0\n");
    const auto like = [&](const std::vector<std::string>& options) { return setting.run(table, options); };
    const std::string copy = setting.file("copy.glsl", wall);
    for (const std::string& other : {setting.shader, copy})
        CHECK_THAT(refusal(like({"--like", other})), Contains("bounce of ") && Contains("is compared with itself: ") &&
                                                         Contains("expected another function"));
    const std::string renamed = setting.file("renamed.glsl", replaced(wall, "bounce(", "reflected("));
    CHECK(like({"--like", renamed, "--like-name", "reflected"}).status == 0);
}

TEST_CASE("function: uniforms of included files and of the other shader count") {
    if (!have_software_gl())
        return;
    const Setting setting;
    setting.folder.write("kept.glsl", "uniform float u_Share;\n");
    const std::string shader = setting.file("with.glsl", "#include \"kept.glsl\"\n"
                                                         "float scaled(float x) { return x * u_Share; }\n");
    CHECK_THAT(refusal(run_lockstep({"function", shader, "scaled", "--table",
                                     setting.file("x.csv", "x, result\n1, 2\n"), "--uniform", "u_Share=2", "--gl",
                                     software_gl(), "--json", setting.folder.path() / "kept.glsl"})),
               Contains("kept.glsl: cannot be written: the run reads it"));
    const std::string other = setting.file("other.glsl", "uniform float u_Part;\n"
                                                         "float scaled(float x) { return x * u_Part; }\n");
    const std::string table = setting.file("rows.csv", "x\n4\n");
    const auto run = [&](const std::vector<std::string>& uniforms) {
        std::vector<std::string> command{"function", shader, "scaled", "--table",    table,
                                         "--like",   other,  "--gl",   software_gl()};
        for (const std::string& uniform : uniforms)
            command.insert(command.end(), {"--uniform", uniform});
        return run_lockstep(command);
    };
    CHECK(run({"u_Share=0.5", "u_Part=0.5"}).status == 0);
    CHECK(run({"u_Share=0.5", "u_Part=0.25"}).status == 1);
    CHECK_THAT(refusal(run({"u_Share=0.5", "u_Prt=0.5"})), Contains("declares no uniform u_Prt; did you mean u_Part?"));
    const std::string missing = refusal(run({"u_Part=0.5"}));
    CHECK_THAT(missing, Contains("kept.glsl:1: nothing is given for uniform u_Share; --uniform NAME=VALUE gives it"));
    CHECK_THAT(missing, !Contains("bindings.json"));
}

TEST_CASE("function: its definition is the one that the preprocessor takes, whatever its types are called") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("kept.glsl", "#define real float\n"
                                                         "#ifdef FAST\n"
                                                         "real kept(real x) { return x; }\n"
                                                         "#else\n"
                                                         "real kept(real x) { return x * 2.0; }\n"
                                                         "#endif\n"
                                                         "void main() {}\n");
    const std::string table = setting.file("kept.csv", "x,result\n1,2\n3,6\n");
    const auto run = [&](const std::string& name, const std::vector<std::string>& more) {
        return run_lockstep(joined({"function", shader, name, "--table", table, "--gl", software_gl()}, more));
    };
    CHECK(run("kept", {}).status == 0);
    CHECK(run("kept", {"--define", "FAST=1"}).status == 1);
    CHECK(run("keep", {}).err == "lockstep: shader " + shader + ": defines no function keep; it has kept\n");
    const std::string wider = setting.file("wider.csv", "x,y,result\n1,2,2\n");
    CHECK_THAT(run_lockstep({"function", shader, "kept", "--table", wider, "--gl", software_gl()}).err,
               Contains("float kept(float)"));
}

TEST_CASE("function: of a whole stage the main, shared variables and the layout of its inputs are left out") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string table = setting.file("squares.csv", "x,result\n2,4\n3,9\n"),
                      wrong = setting.file("wrong.csv", "x,result\n2,4\n3,9.5\n");
    const auto run = [&](const std::string& shader, const std::string& rows) {
        return run_lockstep({"function", shader, "square", "--table", rows, "--gl", software_gl()});
    };
    const std::string compute = setting.file(
        "tile.comp", "#version 450\nlayout(local_size_x = 64) in; // a group\nshared float tile[64];\n"
                     "float square(float x) { return x * x; }\n"
                     "void main() {\n    tile[gl_LocalInvocationIndex] = square(2.0);\n    barrier();\n}\n");
    const std::string fragment =
        setting.file("shade.frag", "#version 450\nlayout(early_fragment_tests) in;\nout vec4 o_Colour;\n"
                                   "void main(void) { if (gl_FragCoord.x > 2.0) { discard; } o_Colour = vec4(1); }\n"
                                   "float square(float x) { return x * x; }\n");
    for (const std::string& shader : {compute, fragment}) {
        const Outcome right = run(shader, table);
        INFO(right.out << right.err);
        CHECK(right.status == 0);
        CHECK(run(shader, wrong).status == 1);
    }
    // A block's layout is another word. GL keeps such a block though nothing uses it.
    const std::string block = setting.file("block.glsl", "layout(shared) uniform Values { float k; };\n"
                                                         "float square(float x) { return x * x; }\n");
    CHECK_THAT(refusal(run(block, table)), Contains("block.glsl:1: nothing is given for uniform block Values"));
}

TEST_CASE("function: an array of uniforms gets all its elements, or one by its number") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader =
        setting.file("sum.glsl", "#define SIZE 3\n"
                                 "uniform float u_W[SIZE], u_One;\n"
                                 "uniform vec2[2] u_V;\n"
                                 "float sum(float x) { return u_W[0] * x + u_W[1] + u_W[2] + u_V[1].y + u_One; }\n");
    const std::string table = setting.file("sum.csv", "x,result\n1,14\n2,16\n");
    const auto run = [&](const std::vector<std::string>& uniforms) {
        std::vector<std::string> words{"function", shader, "sum", "--table", table, "--gl", software_gl()};
        for (const std::string& one : uniforms)
            words.insert(words.end(), {"--uniform", one});
        return run_lockstep(words);
    };
    CHECK(run({"u_W=2,3,0", "u_V=7,7,7,8", "u_One=1"}).status == 0);
    CHECK(run({"u_W[0]=2", "u_W[1]=3", "u_W[2]=0", "u_V[0]=7,7", "u_V[1]=7,8", "u_One=1"}).status == 0);
    CHECK(run({"u_W=2,3,1", "u_V=7,7,7,8", "u_One=1"}).status == 1);
    CHECK_THAT(run({"u_W=2,3", "u_V=7,7,7,8", "u_One=1"}).err,
               Contains("--uniform u_W=2,3: expected 3 elements of u_W, each a float"));
    CHECK_THAT(run({"u_W=2,3,0", "u_V=7,7,7", "u_One=1"}).err, Contains("'7' is no vec2"));
    CHECK_THAT(run({"u_W[0]=2", "u_V=7,7,7,8", "u_One=1"}).err, Contains("nothing is given for uniform u_W["));
}

TEST_CASE("function: each command of its page works as printed") {
    if (!have_software_gl())
        return;
    std::ifstream stream("docs/functions.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    // The next indented block behind some words, without its indent.
    const auto block_behind = [&](const std::string& words) {
        std::istringstream lines(page.substr(page.find(words)));
        std::string text;
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("    "))
                text += line.substr(4) + "\n";
            else if (!text.empty())
                break;
        return text;
    };
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "shaders");
    folder.write("shaders/wall.glsl", block_behind("`shaders/wall.glsl` holds the function"));
    folder.write("walls.csv", block_behind("`walls.csv`:"));
    folder.write("walls.json", block_behind("The same as JSON"));
    folder.write("plain.glsl", block_behind("`plain.glsl`:"));
    folder.write("rows.csv", block_behind("`rows.csv`:"));
    int commands = 0;
    const auto run = [&](std::vector<std::string> command) {
        command.insert(command.end(), {"--gl", software_gl()});
        const Outcome outcome =
            run_lockstep(command, {.environment = {{"LOCKSTEP_DATA", std::filesystem::current_path().string()}},
                                   .folder = folder.path().string()});
        INFO(outcome.out << outcome.err);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Contains("AGREE: every bit of "));
        ++commands;
    };
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
        if (!line.starts_with("    lockstep function "))
            continue;
        command.erase(command.begin());
        run(command);
    }
    CHECK(commands == 2);
    run({"function", "shaders/wall.glsl", "bounce", "--table", "walls.json", "--uniform", "u_Kept=0.5"});
}

TEST_CASE("function: what --like leaves undefined is UNDEFINED, too") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string mine = folder.write("mine.glsl", "float kept(float a) { return a; }\n").string();
    const std::string other =
        folder.write("other.glsl", "float unset(float a) {\n    float z;\n    return z;\n}\n").string();
    const std::string table = folder.write("table.csv", "a\n0\n0\n").string();
    const test::Outcome outcome = run_lockstep({"function", mine, "kept", "--table", table, "--like", other,
                                                "--like-name", "unset", "--gl", test::software_gl()});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("UNDEFINED: 2 of 2 rows") && Contains("variable z"));
}

TEST_CASE("function: a text that is not read is said, whatever the rows are held against") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    // The shift is undefined; the double is what lockstep does not interpret.
    const std::string mine =
        folder.write("mine.glsl", "int shifted(int a) {\n    double d = 0.5;\n    return int(d) + (1 << a);\n}\n")
            .string();
    const std::string table = folder.write("table.csv", "a,result\n41,512\n").string();
    const std::string arguments = folder.write("arguments.csv", "a\n3\n").string();
    const std::string json = (folder.path() / "report.json").string();
    const test::Outcome outcome =
        run_lockstep({"function", mine, "shifted", "--table", table, "--json", json, "--gl", test::software_gl()});
    INFO(outcome.out << outcome.err);
    CHECK_THAT(outcome.out, Contains("note      the text is not read: ") && Contains("undefined operands"));
    CHECK(nlohmann::json::parse(std::ifstream(json))["texts_not_read"].size() == 1);
    const std::string other = folder.write("other.glsl", "int shifted(int a) {\n    return 1 << a;\n}\n").string();
    CHECK_THAT(
        run_lockstep({"function", other, "shifted", "--table", arguments, "--like", mine, "--gl", test::software_gl()})
            .out,
        Contains("note      the text is not read: "));
}

TEST_CASE("function: an expression of 20,000 terms ends in a verdict or in one line, whatever a compiler makes of it") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    std::string sum = "a";
    for (int i = 0; i < 20000; ++i)
        sum += " + a";
    const std::string file = folder.write("sum.glsl", "float sum(float a) { return " + sum + "; }\n").string();
    const std::string table = folder.write("table.csv", "a,result\n0,0\n").string();
    const test::Outcome outcome =
        run_lockstep({"function", file, "sum", "--table", table, "--gl", test::software_gl()});
    INFO(outcome.out << outcome.err);
    CHECK((outcome.status == 0 || outcome.status == 2));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == (outcome.status == 0 ? 0 : 1));
}

TEST_CASE("function: a row that rests on an operand without a result is UNDEFINED with its rule, whatever came out") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string shader = setting.file("open.glsl", "float power(float x, float y) { return pow(x, y); }\n"
                                                         "uint kept(int n) { return 7u << n; }\n"
                                                         "float unset(float x) {\n"
                                                         "    float y;\n"
                                                         "    if (x > 0.0) y = 1.0;\n"
                                                         "    return y + x;\n"
                                                         "}\n"
                                                         "float endless(float x) {\n"
                                                         "    while (x > 0.0) x += 0.0;\n"
                                                         "    return x;\n"
                                                         "}\n");
    const auto run = [&](const std::string& name, const std::string& table) {
        return run_lockstep(
            {"function", shader, name, "--table", setting.file(name + ".csv", table), "--gl", software_gl()});
    };
    const Outcome power = run("power", "x, y, result\n2, 2, 4\n-2, 3, -8\n0, 0, 1\n");
    CHECK(power.status == 1);
    CHECK_THAT(
        power.out,
        Contains(
            "verdict   UNDEFINED: 2 of 3 rows rest on an operation for which GLSL defines no result; every bit of the "
            "other 1 agrees\n") &&
            Contains("row 1     power.csv:3: open.glsl:1: pow of a negative base") && Contains("pow(-2, 3)"));
    const Outcome shift = run("kept", "n, result\n32, 7\n");
    CHECK(shift.status == 1);
    CHECK_THAT(shift.out, Contains("row 0     kept.csv:2: open.glsl:2: shift by a negative count, or by 32 or more"));
    CHECK(run("kept", "n, result\n2, 28\n").status == 0);
    CHECK_THAT(run("unset", "x, result\n-1, -1\n2, 3\n").out,
               Contains("open.glsl:6: use of a variable that was never set (GLSL 4.60, 5.8): variable y"));
    const Outcome endless = run("endless", "x, result\n-1, -1\n1, 1\n2, 2\n");
    CHECK(endless.status == 1);
    CHECK_THAT(endless.out,
               Contains("UNDEFINED: 2 of 3 rows") &&
                   Contains("row 1     endless.csv:3: open.glsl:9: loop that does not end (GLSL 4.60, 6.4)"));
    const Outcome both = run("kept", "n, result\n32, 7\n1, 15\n");
    CHECK(both.status == 1);
    CHECK_THAT(both.out, Contains("DIVERGENT") && Contains("UNDEFINED: 1 of 2 rows"));
}

TEST_CASE("function: what its own text leaves open is legal, a slip is not") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string fresnel = "float fresnel(float c) { return 0.04 + 0.96 * pow(1.0 - c, 5.0); }\n";
    const std::string hue = "vec3 rgb(vec3 c) {\n"
                            "    vec3 p = abs(fract(c.xxx + vec3(1.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - vec3(3.0));\n"
                            "    return c.z * mix(vec3(1.0), clamp(p - vec3(1.0), 0.0, 1.0), c.y);\n"
                            "}\n";
    std::string cosines = "c, result\n", colours = "c.x, c.y, c.z, result.x, result.y, result.z\n";
    for (int i = 0; i < 60; ++i) {
        const float c = static_cast<float>(i) / 60.0F;
        cosines += fmt::format("{}, {}\n", c, static_cast<float>(0.04 + 0.96 * std::pow(1.0 - double{c}, 5.0)));
        const float h = static_cast<float>(i) * 0.0167F, saturation = 0.3F + 0.01F * static_cast<float>(i), v = 0.9F;
        colours += fmt::format("{}, {}, {}", h, saturation, v);
        for (const double third : {1.0, 2.0 / 3.0, 1.0 / 3.0}) {
            const double turned = double{h} + third, part = std::abs((turned - std::floor(turned)) * 6.0 - 3.0);
            const double tone = std::clamp(part - 1.0, 0.0, 1.0);
            colours += fmt::format(", {}", static_cast<float>(double{v} * (1.0 + (tone - 1.0) * double{saturation})));
        }
        colours += "\n";
    }
    const auto run = [&](const std::string& text, const std::string& name, const std::string& table,
                         const std::vector<std::string>& more = {}) {
        return run_lockstep(joined({"function", setting.file("open.glsl", text), name, "--table",
                                    setting.file("open.csv", table), "--gl", software_gl()},
                                   more));
    };
    for (const auto& [text, name, table] : {std::tuple(fresnel, "fresnel", cosines), std::tuple(hue, "rgb", colours)}) {
        const Outcome right = run(text, name, table);
        INFO(right.out << right.err);
        CHECK(right.status == 0);
        CHECK_THAT(right.out, Contains("verdict   LEGAL") || Contains("verdict   AGREE"));
    }
    for (const auto& [what, by] :
         {std::pair("0.96", "0.95"), std::pair("5.0", "4.0"), std::pair("1.0 - c", "1.0 - c * 0.999")}) {
        const Outcome wrong = run(replaced(fresnel, what, by), "fresnel", cosines);
        INFO(wrong.out << wrong.err);
        CHECK(wrong.status == 1);
        CHECK_THAT(wrong.out, Contains("verdict   DIVERGENT") && Contains("open.csv:"));
    }
    for (const auto& [what, by] : {std::pair("2.0 / 3.0, 1.0 / 3.0", "1.0 / 3.0, 2.0 / 3.0"),
                                   std::pair("c.y)", "c.y * 0.999)"), std::pair("* 6.0", "* 5.99")}) {
        const Outcome wrong = run(replaced(hue, what, by), "rgb", colours);
        CHECK(wrong.status == 1);
        CHECK_THAT(wrong.out, Contains("verdict   DIVERGENT"));
    }
    const Outcome precise = run("float fresnel(float c) { precise float y = 0.04 + 0.96 * c; return y; }\n", "fresnel",
                                "c, result\n0.3, 0.32800004\n");
    CHECK(precise.status == 1); // the float beside the only right one
    const Outcome free =
        run("float fresnel(float c) { return 0.04 + 0.96 * c; }\n", "fresnel", "c, result\n0.3, 0.32800004\n");
    INFO(free.out << free.err);
    CHECK(free.status == 0);
}

TEST_CASE("function: without results it is held against its own text, and the report says what that does not prove") {
    if (!have_software_gl())
        return;
    const Setting setting;
    const std::string table =
        setting.file("rows.csv", "velocity.x,velocity.y,velocity.z,n.x,n.y,n.z\n1.1,-2.3,0.7,0.6,0.8,0\n");
    const Outcome alone = setting.run(table);
    INFO(alone.out << alone.err);
    CHECK(alone.status == 0);
    CHECK_THAT(alone.out, Contains("verdict   AGREE") && Contains("its own text, which says nothing about whether"));
    const std::string image = setting.file(
        "image.glsl",
        "uniform sampler2D u_Image;\nfloat texel(int x) { return texelFetch(u_Image, ivec2(x, 0), 0).x; }\n");
    CHECK_THAT(refusal(run_lockstep(
                   {"function", image, "texel", "--table", setting.file("x.csv", "x\n1\n"), "--gl", software_gl()})),
               Contains("image.glsl") && Contains("is not interpreted"));
}

TEST_CASE("function: a port without precise is legal beside its original, as either may round") {
    if (!have_software_gl())
        return;
    const Setting setting;
    std::string rows = "n.x,n.y,n.z,velocity.x,velocity.y,velocity.z\n";
    for (int i = 0; i < 60; ++i)
        rows += fmt::format("{},{},{},{},{},{}\n", std::sin(i), std::cos(i), 0.3, std::sin(7 * i), std::cos(3 * i),
                            std::sin(2 * i));
    const std::string table = setting.file("rows.csv", rows);
    const std::string plain = "uniform float u_Kept;\nvec3 bounce(vec3 velocity, vec3 n) {\n"
                              "    return velocity - ((1.0 + u_Kept) * n) * dot(n, velocity);\n}\n";
    const Outcome legal = run_lockstep({"function", setting.file("plain.glsl", plain), "bounce", "--table", table,
                                        "--like", setting.shader, "--uniform", "u_Kept=0.5", "--gl", software_gl()});
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL"));
    const Outcome wrong = run_lockstep(
        {"function", setting.file("wrong.glsl", replaced(plain, "1.0 + u_Kept", "1.0 + u_Kept * 0.9999")), "bounce",
         "--table", table, "--like", setting.shader, "--uniform", "u_Kept=0.5", "--gl", software_gl()});
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("verdict   DIVERGENT"));
}

} // namespace lockstep::test::function_command_test
