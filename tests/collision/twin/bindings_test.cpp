#include <map>
#include <regex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::bindings_test {

using Catch::Contains;

namespace {

/// Names of an engine's in the place of lockstep's, whole words.
std::string renamed(std::string text, const std::map<std::string, std::string>& names) {
    for (const auto& [ours, theirs] : names)
        text = std::regex_replace(text, std::regex("\\b" + ours + "\\b"), theirs);
    return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

const std::map<std::string, std::string> variables{{"a_Position", "inPosition"},
                                                   {"a_Dir", "inHeading"},
                                                   {"a_Speed", "inSpeed"},
                                                   {"a_CollideTime", "inRest"},
                                                   {"out_Position", "position"},
                                                   {"out_Speed", "speed"},
                                                   {"out_Dir", "heading"},
                                                   {"out_CollideTime", "rest"},
                                                   {"u_CDTexture", "history"},
                                                   {"u_ProjView", "viewProj"},
                                                   {"u_Tick", "dt"},
                                                   {"u_Gravity", "g"},
                                                   {"u_CollisionRange", "reach"},
                                                   {"u_CollisionTime", "pause"},
                                                   {"u_SpeedFactor", "bounce"},
                                                   {"u_TexelCollideRange", "rad"},
                                                   {"u_ClientWidth", "columns"},
                                                   {"u_ClientHeight", "lines"}};

const std::string attributes_and_outputs = R"(
  "attributes": { "inPosition": "a_Position", "inHeading": "a_Dir", "inSpeed": "a_Speed", "inRest": "a_CollideTime" },
  "outputs": { "position": "out_Position", "speed": "out_Speed", "heading": "out_Dir", "rest": "out_CollideTime" })";

const std::string fragment = "#version 400 core\n"
                             "flat in vec3 position;\n"
                             "out vec4 texel;\n"
                             "void main() { texel = vec4(position, 1.0); }\n";

/// A shader of lockstep's with an engine's names, in one of its styles, and the file that binds them.
struct Foreign {
    std::string text, bindings;
};

/// Uniforms one by one; the image's size in one vector, and so are two of the constants.
Foreign one_by_one(const std::string& text) {
    std::string made = renamed(text, variables);
    made = std::regex_replace(made, std::regex("uniform int (columns|lines|rad);\n"), "");
    made = std::regex_replace(made, std::regex("uniform float (reach|pause);\n"), "");
    made = replaced(made, "uniform mat4 viewProj;",
                    "uniform mat4 viewProj;\nuniform vec2 size;\nuniform vec2 limits;\nuniform uint window;\n"
                    "int columns = int(size.x), lines = int(size.y), rad = int(window);\n"
                    "float reach = limits.y, pause = limits.x;");
    return {made, "{ \"uniforms\": { \"viewProj\": \"u_ProjView\", \"history\": \"u_CDTexture\", \"dt\": \"u_Tick\", "
                  "\"g\": \"u_Gravity\", \"bounce\": \"u_SpeedFactor\", \"window\": [\"u_TexelCollideRange\"], "
                  "\"size\": [\"u_ClientWidth\", \"u_ClientHeight\"], "
                  "\"limits\": [\"u_CollisionTime\", \"u_CollisionRange\"] },\n" +
                      attributes_and_outputs + " }"};
}

/// All but the texture in a uniform block, with an instance's name or without, the matrix by rows or by columns.
Foreign in_block(const std::string& text, bool instance, bool by_rows) {
    std::string made = renamed(text, variables);
    made = std::regex_replace(made, std::regex("uniform (mat4|int|float|vec3) [a-zA-Z]+;\n"), "");
    const std::string block =
        "layout(std140) uniform Frame {\n    float bounce;\n    vec3 g;\n    int rad;\n    ivec2 size;\n    " +
        std::string(by_rows ? "layout(row_major) " : "") +
        "mat4 viewProj;\n    float dt, reach, pause;\n    vec2 unused;\n}" + (instance ? " frame;\n" : ";\n");
    made = replaced(made, "uniform sampler2D history;\n", "uniform sampler2D history;\n" + block);
    std::map<std::string, std::string> members{{"columns", "size.x"}, {"lines", "size.y"}};
    if (instance)
        members = {{"columns", "frame.size.x"}, {"lines", "frame.size.y"},  {"viewProj", "frame.viewProj"},
                   {"dt", "frame.dt"},          {"g", "frame.g"},           {"reach", "frame.reach"},
                   {"pause", "frame.pause"},    {"bounce", "frame.bounce"}, {"rad", "frame.rad"}};
    const std::size_t body = made.find("void main()");
    REQUIRE(body != std::string::npos);
    made = made.substr(0, body) + renamed(made.substr(body), members);
    return {made, "{ \"uniforms\": { \"history\": \"u_CDTexture\" },\n  \"uniform_blocks\": { \"Frame\": { "
                  "\"viewProj\": \"u_ProjView\", \"dt\": \"u_Tick\", \"g\": \"u_Gravity\", \"bounce\": "
                  "\"u_SpeedFactor\", \"rad\": \"u_TexelCollideRange\", \"size\": [\"u_ClientWidth\", "
                  "\"u_ClientHeight\"], \"reach\": \"u_CollisionRange\", \"pause\": \"u_CollisionTime\", "
                  "\"unused\": [0, 0.5] } },\n" +
                      attributes_and_outputs + " }"};
}

/// In a uniform that is a structure; its members go by their own names.
Foreign in_structure(const std::string& text) {
    Foreign made = in_block(text, true, false);
    made.text = replaced(replaced(made.text, "layout(std140) uniform Frame {", "struct Frame {"), "} frame;",
                         "};\nuniform Frame frame;");
    made.bindings = replaced(
        replaced(made.bindings, "\"u_CDTexture\" },\n  \"uniform_blocks\": { \"Frame\": {", "\"u_CDTexture\","),
        "\"unused\": [0, 0.5] } }", "\"unused\": [0, 0.5] }");
    return made;
}

std::vector<Foreign> styles(const std::string& text) {
    return {one_by_one(text), in_block(text, true, false), in_block(text, false, true), in_structure(text)};
}

void write(const test::TemporaryFolder& folder, const Foreign& foreign) {
    folder.write("collision_pass.vert", foreign.text);
    folder.write("collision_pass.geom", "");
    folder.write("collision_pass.frag", fragment);
    folder.write("bindings.json", foreign.bindings);
}

std::string error_of(const Foreign& foreign) {
    const test::TemporaryFolder shaders;
    write(shaders, foreign);
    try {
        static_cast<void>(test::check_twins(test::crowded_scene(200), 2, shaders.path()));
        return "no error";
    } catch (const Error& error) {
        return error.what();
    }
}

const char* const base = "tests/collision/right_shaders/precise.vert";

} // namespace

TEST_CASE("bindings: right shaders with names, vectors and uniform blocks of their own agree without an edit") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* file : {"precise", "mix_selects", "one_loop", "while_loops"}) {
        const std::string text = test::content("tests/collision/right_shaders/" + std::string(file) + ".vert");
        for (const Foreign& foreign : styles(text)) {
            INFO(file << "\n" << foreign.text);
            const test::TemporaryFolder shaders;
            write(shaders, foreign);
            const CheckReport report = test::check_twins(test::crowded_scene(), 6, shaders.path());
            CHECK(report.verdict == Verdict::agree);
            CHECK(report.hits > 100);
        }
    }
}

TEST_CASE("bindings: a planted bug in such a shader has its cause by name") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::pair<const char*, std::pair<const char*, const char*>> bugs[] = {
        {"last_found_instead_of_nearest", {" && distance_to < best)", ")"}},
        {"timer_not_set", {"out_CollideTime = u_CollisionTime;", "out_CollideTime = a_CollideTime;"}},
        {"towards_neighbour", {"a_Position - other.xyz", "other.xyz - a_Position"}}};
    for (const auto& [cause, change] : bugs)
        for (const Foreign& foreign : styles(replaced(test::content(base), change.first, change.second))) {
            const test::TemporaryFolder shaders;
            write(shaders, foreign);
            const CheckReport report = test::check_twins(test::crowded_scene(), 6, shaders.path());
            REQUIRE(report.verdict == Verdict::divergent);
            std::string told;
            for (const CauseFindings& found : report.verdicts->causes)
                for (const Cause& one : found.best)
                    told += one.name() + " ";
            INFO(cause << ", told: " << told);
            CHECK(!told.empty());
        }
}

TEST_CASE("bindings: a number of its own is what a uniform holds") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    std::string text = test::content(base);
    text = replaced(text, "#version 400 core\n", "#version 400 core\nuniform vec3 weights;\nuniform int twice;\n");
    text = replaced(text, "* u_SpeedFactor", "* u_SpeedFactor * weights.y * float(twice)");
    const test::TemporaryFolder shaders;
    shaders.write("collision_pass.vert", text);
    shaders.write("collision_pass.geom", "");
    shaders.write("bindings.json", R"({ "uniforms": { "weights": [3, 0.5, 7.25], "twice": 2 } })");
    CHECK(test::check_twins(test::crowded_scene(), 4, shaders.path()).verdict == Verdict::agree);
    shaders.write("bindings.json", R"({ "uniforms": { "weights": [3, 0.25, 7.25], "twice": 2 } })");
    CHECK(test::check_twins(test::crowded_scene(), 4, shaders.path()).verdict == Verdict::divergent);
}

TEST_CASE("bindings: a list has names and numbers; one number fills an array or a structure") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    std::string text = test::content(base);
    text = replaced(text, "#version 400 core\n",
                    "#version 400 core\nstruct Light { vec4 colour[2]; mat3 turn; float share; };\n"
                    "layout(std140) uniform Frame { Light lights[3]; mat4 bones[4]; float halves[2]; };\n"
                    "uniform vec3 step_of[2], resolution;\nuniform Light sun;\n");
    text = replaced(text, "* u_SpeedFactor",
                    "* u_SpeedFactor * (resolution.z + lights[1].share + bones[3][2].y + "
                    "sun.colour[1].w) * halves[1] * 2.0 * step_of[1].y");
    const test::TemporaryFolder shaders;
    shaders.write("collision_pass.vert", text);
    shaders.write("collision_pass.geom", "");
    const auto verdict = [&](const std::string& uniforms, const std::string& members) {
        shaders.write("bindings.json",
                      "{ \"uniforms\": { " + uniforms + " }, \"uniform_blocks\": { \"Frame\": { " + members + " } } }");
        return test::check_twins(test::crowded_scene(), 4, shaders.path()).verdict;
    };
    const std::string uniforms = R"("resolution": ["u_ClientWidth", "u_ClientHeight", 1], "step_of": 1, "sun": 0)";
    const std::string members = R"("lights": 0, "bones": 0, "halves": 0.5)";
    CHECK(verdict(uniforms, members) == Verdict::agree);
    CHECK(verdict(replaced(uniforms, ", 1]", ", 0.5]"), members) == Verdict::divergent);
    CHECK(verdict(uniforms, replaced(members, "0.5", "0.25")) == Verdict::divergent);
    CHECK(verdict(uniforms, R"("lights[1].share": 1, )" + members) == Verdict::divergent);
    CHECK_THROWS_WITH(verdict(uniforms, replaced(members, "\"bones\": 0", "\"bones\": 1")),
                      Contains("/uniform_blocks/Frame/bones: Frame.bones[") &&
                          Contains("is mat4; the number for it is 0"));
    CHECK_THROWS_WITH(verdict(uniforms, replaced(members, "\"lights\": 0", "\"lights\": \"u_Tick\"")),
                      Contains("/uniform_blocks/Frame/lights: Frame.lights[") &&
                          Contains("right for all of them is one number"));
    CHECK_THROWS_WITH(verdict(replaced(uniforms, "u_ClientHeight", "u_ClientHeigth"), members),
                      Contains("nothing is given for uniform resolution (bound to u_ClientHeigth)"));
}

TEST_CASE("bindings: what does not fit is told with the file, the place in it and what would be right") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::string text = test::content(base);
    const Foreign plain = one_by_one(text), block = in_block(text, true, false);
    const auto with = [](Foreign foreign, const std::string& what, const std::string& by) {
        foreign.bindings = replaced(foreign.bindings, what, by);
        return error_of(foreign);
    };
    CHECK_THAT(with(plain, "{ \"uniforms\"", "{ uniforms"), Contains("bindings.json:1:3: malformed JSON"));
    CHECK_THAT(with(plain, "\"viewProj\"", "\"viewProj\": 1, \"viewProj\""),
               Contains("bindings.json: /uniforms: the key \"viewProj\" stands twice in one object"));
    CHECK_THAT(with(plain, "\"uniforms\"", "\"uniform\""),
               Contains("bindings.json: /uniform: is none of uniforms, uniform_blocks, storage_blocks, attributes, "
                        "outputs; did you mean "
                        "uniforms?"));
    CHECK_THAT(with(plain, "\"viewProj\"", "\"viewProjj\""),
               Contains("/uniforms/viewProjj: no shader beside it has the name viewProjj; did you mean viewProj?"));
    CHECK_THAT(with(plain, "\"u_Tick\"", "\"u_Tik\""),
               Contains("nothing is given for uniform dt (bound to u_Tik); did you mean float u_Tick?"));
    CHECK_THAT(with(plain, "\"u_Tick\"", "\"u_Gravity\""), Contains("uniform dt is float, but must be vec3"));
    CHECK_THAT(with(plain, "\"u_ClientWidth\", ", ""), Contains("/uniforms/size: 1 value for a vec2"));
    CHECK_THAT(with(plain, "\"u_ClientWidth\", \"u_ClientHeight\"", "\"u_ClientWidth\", \"u_Gravity\""),
               Contains("y of uniform size must be one number, but u_Gravity is vec3"));
    CHECK_THAT(with(plain, "\"u_ClientWidth\", \"u_ClientHeight\"", "\"u_Gravity.x\", \"u_Gravity.y\""),
               Contains("uniform size is bound to u_Gravity.x, a component; right is u_Gravity as a whole; bindings"));
    CHECK_THAT(with(plain, "\"dt\": \"u_Tick\"", "\"dt\": true"),
               Contains("/uniforms/dt: is neither a name nor a number"));
    CHECK_THAT(with(plain, "\"dt\": \"u_Tick\"", "\"dt\": []"),
               Contains("/uniforms/dt: is an empty list; right are names and numbers"));
    CHECK_THAT(with(plain, "\"speed\": \"out_Speed\"", "\"speed\": \"out_Sped\""),
               Contains("output out_Speed is not written by the last vertex-processing stage"));
    CHECK_THAT(with(plain, "\"inRest\": \"a_CollideTime\"", "\"inRest\": \"a_Speed\""),
               Contains("/attributes/inSpeed: a_Speed has a name already"));
    CHECK_THAT(with(plain, "\"inRest\": \"a_CollideTime\"", "\"inRest\": \"a_CollidTime\""),
               Contains("nothing is given for attribute inRest (bound to a_CollidTime); did you mean float "
                        "a_CollideTime?"));
    CHECK_THAT(with(block, "\"pause\": \"u_CollisionTime\", ", ""),
               Contains("nothing is given for uniform Frame.pause"));
    CHECK_THAT(with(block, "\"Frame\"", "\"Frames\""),
               Contains("/uniform_blocks/Frames: no shader beside it has the name Frames; did you mean Frame?"));
    Foreign unbound = block;
    unbound.bindings = "{ \"uniforms\": { \"history\": \"u_CDTexture\" }," + attributes_and_outputs + " }";
    CHECK_THAT(error_of(unbound), Contains("nothing is given for uniform block Frame; bindings.json beside the shader "
                                           "binds its members"));
}

} // namespace lockstep::test::bindings_test
