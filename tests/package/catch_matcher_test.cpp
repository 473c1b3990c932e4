#include <lockstep/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/package/reference_engine.hpp"
#include "tests/package/shell.hpp"

namespace lockstep::test::catch_matcher_test {

using Catch::Contains;
using test::ReferenceEngine;

namespace {

Scene streams() { return load_scene(shipped_scene("x_streams"), {.particles = 300}); }

void speed_up(int frame, Particles& particles) {
    if (frame == 3)
        particles.speed[7] = std::nextafter(particles.speed[7], 2.0F);
}

/// The repeat line of a failed assertion as one pastes it into a shell.
std::string pasted_command(const std::string& output) {
    const std::size_t begin = output.find("  repeat    ");
    REQUIRE(begin != std::string::npos);
    std::size_t end = output.find('\n', begin);
    while (output[end - 1] == '\\')
        end = output.find('\n', end + 1);
    return output.substr(begin + 12, end - begin - 12);
}

} // namespace

TEST_CASE("matches reference: an engine that computes the same") {
    const Scene scene = streams();
    ReferenceEngine engine(scene);
    CHECK_THAT(engine, MatchesReference(scene).frames(8));
}

TEST_CASE("matches reference: modifiers reach the check") {
    const Scene scene = streams();
    ReferenceEngine engine(scene, speed_up);
    CHECK_THAT(engine, MatchesReference(scene).frames(3));
    ReferenceEngine frames(scene, speed_up);
    CHECK_THAT(frames, !MatchesReference(scene).frames(4));
    ReferenceEngine legal(scene, speed_up);
    CHECK_THAT(legal, MatchesReference(scene).frames(8).legal(Legal::any_order));
    ReferenceEngine free(scene, speed_up);
    const MatchesReference in_free_mode = MatchesReference(scene).frames(8).mode(CheckMode::free);
    CHECK_FALSE(in_free_mode.match(free));
    CHECK_THAT(in_free_mode.describe(), Contains("DIFFER from frame 3"));
}

TEST_CASE("matches reference: fails, as asked; with [marks], commas", "[.fails]") {
    const Scene scene = streams();
    ReferenceEngine engine(scene, speed_up);
    CHECK_THAT(engine, MatchesReference(scene).frames(8));
}

TEST_CASE(
    "matches reference: a failure is the program's report; verdict, first and a line that repeats it come first") {
    const test::ShellOutcome failed = test::run_in_shell(this_program({"[.fails]"}));
    INFO(failed.out);
    CHECK(failed.status == 1);
    CHECK_THAT(failed.out, Contains("  an engine of its own is to match the reference\n"
                                    "  verdict   DIVERGENT from frame 3 on: 1 particle state") &&
                               Contains("  first     frame 3 particle 7, divergent"));
    CHECK(failed.out.find("  first  ") < failed.out.find("  repeat  "));
    CHECK(failed.out.find("  repeat  ") < failed.out.find("  scene     x_streams ("));
    std::istringstream lines(failed.out.substr(failed.out.find("with expansion:\n")));
    int count = 0;
    for (std::string line; std::getline(lines, line) && line.find("=====") == std::string::npos; ++count)
        if (line.find('/') == std::string::npos)
            CHECK(line.size() <= 79);
    CHECK(count <= 62);
    const test::ShellOutcome again = test::run_in_shell(pasted_command(failed.out));
    CHECK(again.status == 1);
    CHECK_THAT(again.out, Contains("verdict   DIVERGENT from frame 3 on"));
}

} // namespace lockstep::test::catch_matcher_test
