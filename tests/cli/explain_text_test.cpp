#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::explain_text_test {

using Catch::Contains;
using Catch::Matches;

namespace {

struct Item {
    std::string scene, frame, pass, item;
};

Outcome explain(const Item& of, const std::vector<std::string>& more = {}) {
    return run_lockstep(joined({"explain", "data/scenes/" + of.scene, "--frame", of.frame, "--pass", of.pass, "--item",
                                of.item, "--gl", software_gl()},
                               more));
}

/// Lines of the table that have nothing of the GPU's.
std::vector<std::string> untold_rows(const std::string& text) {
    std::vector<std::string> rows;
    const std::size_t table = text.find("\n  step "), end = text.find("\nverdict ");
    for (std::size_t at = text.find('\n', table + 1); at != std::string::npos && at < end;
         at = text.find('\n', at + 1)) {
        const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
        if (line.find(" -  ") != std::string::npos || line.ends_with(" -"))
            rows.push_back(line);
    }
    return rows;
}

} // namespace

TEST_CASE("explain: each row has what the shader's text comes by, which ends in the GPU's bits") {
    if (!have_software_gl())
        return;
    const std::vector<Item> items{
        {"dust/box.json", "1", "update", "3"},
        {"lifecycle/embers.json", "12", "move", "17"},
        {"fluid/one_sphere.json", "0", "normal_pass", "91,57"},
        {"fluid/one_sphere.json", "0", "depth_filter_pass", "91,57"},
        {"lights/one_light.json", "0", "light_volume_gather", "3,1,1"},
    };
    for (const Item& item : items) {
        CAPTURE(item.scene, item.pass);
        const Outcome outcome = explain(item);
        CAPTURE(outcome.out, outcome.err);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Contains(".comp, run by lockstep: it ends in the GPU's bits"));
        CHECK(untold_rows(outcome.out) == std::vector<std::string>());
    }
}

TEST_CASE("explain: values of the text stand at their variable and line, decisions with what they compare") {
    if (!have_software_gl())
        return;
    const std::string out = explain({"dust/box.json", "1", "update", "3"}).out;
    CAPTURE(out);
    CHECK_THAT(out, Contains("update.comp:40     m.velocity"));
    CHECK_THAT(out, Contains("update.comp:41 m.next.y"));
    CHECK_THAT(out, Contains("colliders.glsl:134 286.110199 <= 0.0100000007 no"));
}

TEST_CASE("explain: what a wrong shader's text never comes by is said") {
    if (!have_software_gl())
        return;
    const TemporaryFolder shaders;
    plant(shaders, "update.comp", "    a = add(a, gravity);\n", "    a = add(a, mul(gravity, 2.0));\n");
    const std::string out = explain({"dust/box.json", "1", "update", "3"}, {"--shaders", shaders.path().string()}).out;
    CAPTURE(out);
    CHECK_THAT(out, Contains("velocity of the fall.y"));
    CHECK_THAT(out, Contains("not in the text"));
    CHECK_THAT(out, Contains("a                         (0, -19.6000004, 0)"));
    CHECK_THAT(out, Contains("update.comp, run by lockstep: it ends in the GPU's bits"));
}

TEST_CASE("debug and the report page show the text's values too") {
    if (!have_software_gl())
        return;
    const Outcome outcome = run_lockstep({"debug", "data/scenes/dust/box.json", "--gl", software_gl()},
                                         {.standard_input = "frame 1\npass update\nitem 3\nshow\nquit\n"});
    CAPTURE(outcome.out, outcome.err);
    CHECK_THAT(outcome.out, Contains("update.comp:41 m.next.y"));
}

TEST_CASE("debug goes by the shader's lines, shows them, and stops at one") {
    if (!have_software_gl())
        return;
    const Outcome outcome =
        run_lockstep({"debug", "data/scenes/dust/box.json", "--gl", software_gl()},
                     {.standard_input = "frame 1\npass update\nitem 3\nline\nline\nline 4\n"
                                        "break update.comp:41\nbreak update.comp:1000\nbreak\ncontinue\nquit\n"});
    CAPTURE(outcome.out, outcome.err);
    CHECK_THAT(outcome.out, Contains("update.comp:25: uint i = gl_GlobalInvocationID.x;\n    i = 3\n"));
    CHECK_THAT(outcome.out, Contains("update.comp:26: if (i >= dustCount || dust[i].isAlive != 1)\n"
                                     "    3 >= 100000 is no\n    1 != 1 is no\n"));
    CHECK_THAT(outcome.out, Contains("break where this item comes to update.comp:41\n"));
    CHECK_THAT(outcome.out, Contains("frame 2 update, grain 3\nupdate.comp:41: m.next = add("));
}

TEST_CASE("debug: a pass without a text has no lines to go by") {
    if (!have_software_gl())
        return;
    const Outcome outcome =
        run_lockstep({"debug", "data/scenes/lattice.json", "--particles", "100", "--gl", software_gl()},
                     {.standard_input = "line\n"});
    CHECK_THAT(outcome.err, Contains("no lines of a shader's text: this pass has no text that is run"));
}

} // namespace lockstep::test::explain_text_test
