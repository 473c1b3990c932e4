#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/collision/report/collision_debug_run.hpp"
#include "crosscheck/report/debug_session.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::debug_session_test {

namespace {

DebugSession session_of(const test::TemporaryFolder& shaders, int frames = 4) {
    DebugSetup setup;
    setup.frames = frames;
    setup.start = [&shaders](const std::vector<std::string>& changes) {
        Scene scene = test::crowded_scene(300, 61, 47);
        for (const std::string& change : changes)
            set_switch(scene.switches, change.substr(0, change.find('=')), change.substr(change.find('=') + 1));
        const Profile profile = test::llvmpipe_profile(shaders.path());
        return std::make_unique<CollisionDebugRun>(
            std::make_unique<FrameRun>(std::move(scene), profile, measured_operations(profile), shaders.path()));
    };
    return DebugSession(std::move(setup));
}

std::string error_of(DebugSession& session, const std::string& line) {
    try {
        return "no error, but " + session.obey(line);
    } catch (const Error& error) {
        return error.what();
    }
}

std::string label(const std::string& row) { return row.substr(2, row.find("  ", 2) - 2); }

} // namespace

TEST_CASE("debug_session: a command that cannot be done says why and changes nothing") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    DebugSession session = session_of(shaders);
    const std::pair<const char*, const char*> wrong[] = {
        {"nonsense",
         "unknown command 'nonsense'; the commands are frame, particle, texel, show, step, back, line, next, why, "
         "print, history, break, continue, set, list, source, help, quit"},
        {"frame", "frame: '' is not an integer from 0 to 100000000"},
        {"frame -1", "frame: '-1' is not an integer from 0 to 100000000"},
        {"frame 1.5", "frame: '1.5' is not an integer from 0 to 100000000"},
        {"particle", "there is no particle ''; crowded has 0 to 299"},
        {"particle 300", "there is no particle '300'; crowded has 0 to 299"},
        {"texel", "there is no texel ''; the CDT has 0,0 to 60,46"},
        {"texel 61,1", "there is no texel '61,1'; the CDT has 0,0 to 60,46"},
        {"print", "print: the name of a row is missing; `show` lists them"},
        {"continue on", "continue: takes no argument, not 'on'"},
        {"break speed < ", "break: 'speed <' is not NAME < NUMBER; <=, >, >=, ==, != go as well"},
        {"show me", "show: takes no argument, not 'me'"},
        {"step 0", "step: '0' is not an integer from 1 to 1000000"},
        {"back x", "back: 'x' is not an integer from 1 to 1000000"},
        {"next", "next: '' is not one of fetch, difference, divergence, nan"},
        {"next hit", "next: 'hit' is not one of fetch, difference, divergence, nan"},
        {"next difference", "frame 1 particle 7: no further difference up to frame 3; --frames sets how far is looked"},
        {"next divergence", "frame 1 particle 7: no further divergence up to frame 3; --frames sets how far is looked"},
        {"next nan", "frame 1 particle 7: no further nan up to frame 3; --frames sets how far is looked"},
        {"why not", "why: takes no argument, not 'not'"},
        {"set", "set: '' is not NAME=VALUE"},
        {"set arithmetic", "set: 'arithmetic' is not NAME=VALUE"},
        {"list", "list: '' is not one of rounding, tie, undefined, divergent"},
        {"list all", "list: 'all' is not one of rounding, tie, undefined, divergent"},
        {"help me", "help: takes no argument, not 'me'"},
        {"source", "source: the name of a file of commands is missing"},
        {"quit now", "quit: takes no argument, not 'now'"},
    };
    CHECK(error_of(session, "back") == "frame 0 particle 0: no row yet to go back from");
    session.obey("frame 1");
    session.obey("particle 7");
    session.obey("step 2");
    for (const auto& [line, message] : wrong) {
        CHECK(error_of(session, line) == message);
        session.obey("back");
        CHECK(label(session.obey("step")) == "clip.y");
    }
    CHECK_THAT(error_of(session, "set arithmetic=loose"), Catch::Contains("plain") && Catch::Contains("exact"));
    CHECK_THAT(error_of(session, "set no_such=1"), Catch::Contains("no_such"));
    CHECK_FALSE(session.ended());
}

TEST_CASE("debug_session: the table ends where it ends") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    DebugSession session = session_of(shaders);
    CHECK(label(session.obey("step 1000")) == "stored.w");
    CHECK(error_of(session, "step") == "frame 0 particle 0: stored.w is the last row");
    CHECK(error_of(session, "next fetch") == "frame 0 particle 0: no further fetch");
    CHECK(label(session.obey("back 1000")) == "clip.x");
    CHECK(error_of(session, "back") == "frame 0 particle 0: clip.x is the first row");
}

TEST_CASE("debug_session: list names what differs, at most twenty") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    DebugSession right = session_of(shaders);
    for (const char* kind : {"divergent", "undefined", "tie", "rounding"})
        CHECK(right.obey("list " + std::string(kind)) == "nothing " + std::string(kind) + " in frame 0\n");
    test::plant(shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;", "ls_flush(a_CollideTime);");
    DebugSession wrong = session_of(shaders);
    const std::string listed = wrong.obey("list divergent");
    CHECK_THAT(listed, Catch::StartsWith("particle 0\nparticle 1\n") &&
                           Catch::EndsWith("particle 18\nparticle 19\nand 280 more\n"));
    CHECK_THAT(wrong.obey("why"), Catch::StartsWith("particle 0 in frame 0: divergent\n") &&
                                      Catch::Contains("the GPU is not: collide time: no hit") &&
                                      Catch::Contains("  step collide time: "));
}

TEST_CASE("debug_session: next goes from one divergent particle to the next, and on to the next frame") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "v_Speed = ls_length(temp);",
                "v_Speed = gl_VertexID == 20 || gl_VertexID == 9 ? 1.0 : ls_length(temp);");
    DebugSession session = session_of(shaders, 2);
    for (const char* place :
         {"frame 0 particle 9\n", "frame 0 particle 20\n", "frame 1 particle 9\n", "frame 1 particle 20\n"}) {
        const std::string found = session.obey("next divergence");
        CHECK_THAT(found, Catch::StartsWith(place) && Catch::EndsWith("DIVERGENT\n"));
        CHECK(label(found.substr(found.find('\n') + 1)) == "speed");
    }
    CHECK_THAT(error_of(session, "next divergence"), Catch::StartsWith("frame 1 particle 20: no further divergence"));
}

TEST_CASE("debug_session: set changes both sides and keeps the place") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    DebugSession session = session_of(shaders);
    session.obey("frame 2");
    session.obey("particle 11");
    CHECK(session.obey("set base_texel=truncate") == "frame 2: particles: none differ; texels: none differ\n");
    session.obey("set arithmetic=exact");
    CHECK_THAT(session.obey("why"), Catch::StartsWith("particle 11 in frame 2: every bit agrees\n"));
    session.obey("texel 30,20");
    session.obey("set self_position=texel");
    CHECK_THAT(session.obey("why"), Catch::StartsWith("texel (30, 20) in frame 2: every bit agrees\n"));
    CHECK(session.obey("quit").empty());
    CHECK(session.ended());
}

} // namespace lockstep::test::debug_session_test
