#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "gpu/program.hpp"
#include "gpu/stage_texts.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::output_names_test {

namespace {

using Names = std::vector<std::string>;

std::string stage_with(const std::string& instance, const std::string& prefix) {
    return "#version 330 core\nin float a_Speed;\nout Mote { vec3 out_Place; flat float out_Speed; }" + instance +
           ";\nout vec4 out_Beside;\nvoid main() { " + prefix + "out_Place = vec3(1.0); " + prefix +
           "out_Speed = a_Speed; out_Beside = vec4(2.0); gl_Position = vec4(0.0); }\n";
}

} // namespace

TEST_CASE("output names: an output in a block goes by its own name, its block's and its instance's") {
    CHECK(spellings(stage_with("", ""), "out_Speed") == Names{"out_Speed", "Mote.out_Speed"});
    CHECK(spellings(stage_with(" mote", "mote."), "out_Speed") ==
          Names{"out_Speed", "Mote.out_Speed", "mote.out_Speed"});
    CHECK(spellings(stage_with(" mote", "mote."), "Mote.out_Place") ==
          Names{"Mote.out_Place", "out_Place", "mote.out_Place"});
    CHECK(spellings(stage_with("", ""), "out_Beside") == Names{"out_Beside"});
    CHECK(spellings(stage_with("", ""), "out_Nothing") == Names{"out_Nothing"});
}

TEST_CASE("output names: a driver's name with a block is that without, and another block's is not") {
    CHECK(is_same_output("out_Speed", "out_Speed"));
    CHECK(is_same_output("Mote.out_Speed", "out_Speed"));
    CHECK(is_same_output("out_Speed[0]", "Mote.out_Speed"));
    CHECK_FALSE(is_same_output("out_Speed", "out_Place"));
    CHECK_FALSE(is_same_output("Mote.out_Speed", "out_Place"));
}

TEST_CASE("output names: outputs in a block are captured by their own names, with an instance and without") {
    const auto context = test::open_context();
    if (!context)
        return;
    const std::vector<Capture> captures{{"out_Place", GL_FLOAT_VEC3}, {"out_Speed", GL_FLOAT}};
    for (const std::string instance : {"", " mote"}) {
        const test::TemporaryFolder folder;
        folder.write("step.vert", stage_with(instance, instance.empty() ? "" : "mote."));
        const std::vector stages{Stage::vertex};
        CHECK_NOTHROW(Program("step", load_stages({folder.path()}, "step", stages), captures));
    }
}

} // namespace lockstep::test::output_names_test
