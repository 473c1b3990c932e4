#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "gpu/shader_log.hpp"

namespace lockstep::test::shader_log_test {

namespace {

/// Four lines, the third of a file that the stage includes.
ShaderSource stage(Stage kind, const std::string& file) {
    ShaderSource source;
    source.stage = kind;
    source.text = "#version 330 core\n#define ONE 1\nfloat x;\nvoid main() {}\n";
    source.files = {file, "part.glsl"};
    source.origins = {{0, 1}, {0, 1}, {1, 7}, {0, 3}};
    return source;
}

using Warnings = std::vector<ShaderWarning>;

} // namespace

TEST_CASE("shader log: warnings of each driver's form have file and line of the files, and what is none is left out") {
    const ShaderSource source = stage(Stage::vertex, "step.vert");
    CHECK(compile_warnings("0:3(12): warning: `junk' used uninitialized\n0:4(1): warning: `b' used uninitialized\n",
                           source) ==
          Warnings{{"part.glsl:7", "`junk' used uninitialized"}, {"step.vert:3", "`b' used uninitialized"}});
    CHECK(compile_warnings("0(4) : warning C7050: \"junk\" might be used before being initialized\n", source) ==
          Warnings{{"step.vert:3", "C7050: \"junk\" might be used before being initialized"}});
    CHECK(compile_warnings("WARNING: 0:4: implicit conversion\n", source) ==
          Warnings{{"step.vert:3", "implicit conversion"}});
    CHECK(compile_warnings("warning: extension is unknown\n", source) ==
          Warnings{{"step.vert", "extension is unknown"}});
    CHECK(compile_warnings("", source).empty());
    CHECK(compile_warnings("No errors.\nVertex shader was successfully compiled to run on hardware.\n"
                           "0(4) : info: it is used\n",
                           source)
              .empty());
    CHECK(compile_warnings("0:4(1): error: no\n", source).empty());
}

TEST_CASE("shader log: an error is found behind warnings") {
    CHECK(first_compile_error("0:3(12): warning: `junk' used uninitialized\n0:4(2): error: `no' undeclared\n",
                              stage(Stage::vertex, "step.vert")) == "step.vert:3: `no' undeclared");
}

TEST_CASE("shader log: a linker's warnings are of the stage whose paragraph they lie in") {
    const std::array stages{stage(Stage::vertex, "step.vert"), stage(Stage::fragment, "step.frag")};
    CHECK(link_warnings("Vertex info\n-----------\n0(4) : warning C7050: \"a\" might be used before being initialized\n"
                        "Fragment info\n-------------\n0(4) : warning C7050: \"b\" might be used before being "
                        "initialized\n",
                        stages) == Warnings{{"step.vert:3", "C7050: \"a\" might be used before being initialized"},
                                            {"step.frag:3", "C7050: \"b\" might be used before being initialized"}});
    CHECK(link_warnings("Vertex shader(s) linked, fragment shader(s) linked.\n", stages).empty());
}

TEST_CASE("shader log: an unset variable is told from other warnings, in each driver's words") {
    CHECK(is_about_unset_variable({"a.vert:1", "`junk' used uninitialized"}));
    CHECK(is_about_unset_variable({"a.vert:1", "C7050: \"junk\" might be used before being initialized"}));
    CHECK_FALSE(is_about_unset_variable({"a.vert:1", "C7011: implicit cast from \"int\" to \"float\""}));
}

} // namespace lockstep::test::shader_log_test
