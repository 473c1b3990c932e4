#include <lockstep/catch.hpp>

#include <stdexcept>

#include <catch2/catch.hpp>

#include "tests/package/reference_engine.hpp"
#include "tests/package/shell.hpp"

namespace lockstep::test::junit_reporter_test {

using Catch::Contains;

namespace {

Scene streams() { return load_scene(shipped_scene("x_streams"), {.particles = 300}); }

} // namespace

TEST_CASE("junit: passes", "[.junit]") {
    const Scene scene = streams();
    test::ReferenceEngine engine(scene);
    CHECK_THAT(engine, MatchesReference(scene).frames(2));
}

TEST_CASE("junit: fails", "[.junit]") {
    const Scene scene = streams();
    test::ReferenceEngine engine(scene, [](int, Particles& particles) { particles.speed[7] = 2.0F; });
    CHECK_THAT(engine, MatchesReference(scene).frames(1));
    CHECK(1 == 2);
}

TEST_CASE("junit: throws", "[.junit]") { throw std::runtime_error("no \"file\" <here>"); }

TEST_CASE("junit: is skipped", "[.junit]") { skip("no GL, as asked"); }

TEST_CASE("junit reporter: pass, fail, error and skipped are told apart, with renderer, profile and verdict") {
    const test::ShellOutcome run =
        test::run_in_shell("unset LOCKSTEP_REQUIRE_GL; " + this_program({"[.junit]", "--reporter", "lockstep-junit"}));
    INFO(run.out);
    CHECK(run.status == 1);
    for (const char* text :
         {R"(tests="4" failures="1" errors="1" skipped="1")",
          R"(<property name="renderer" value="an engine of its own"/>)", R"(<property name="profile" value="strict: )",
          R"(<property name="verdict" value="AGREE, but nothing collided"/>)",
          R"(<property name="verdict" value="DIVERGENT"/>)", "verdict   DIVERGENT from frame 0 on",
          R"(<failure message="DIVERGENT from frame 0 on: )", R"(<error message="no &quot;file&quot; &lt;here>">)",
          R"(<skipped message="no GL, as asked"/>)"})
        CHECK_THAT(run.out, Contains(text));
}

} // namespace lockstep::test::junit_reporter_test
