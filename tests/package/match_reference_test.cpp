#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lockstep/lockstep.hpp>

#include "tests/gpu/any_context.hpp"
#include "tests/package/reference_engine.hpp"
#include "tests/package/shell.hpp"
#include "tests/planted_shader.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::match_reference_test {

using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;
using test::ReferenceEngine;

namespace {

Scene streams() { return load_scene(shipped_scene("x_streams"), {.particles = 300}); }

/// Particle 7 too fast by one bit in frame 3.
void speed_up(int frame, Particles& particles) {
    if (frame == 3)
        particles.speed[7] = std::nextafter(particles.speed[7], 2.0F);
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of('\n');
    return text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

/// The command a report ends with.
std::string repeat_command(const MatchResult& result) {
    const std::string line = last_line(result.text());
    REQUIRE_THAT(line, StartsWith("repeat    "));
    return line.substr(10);
}

} // namespace

TEST_CASE("match_reference: an engine that computes the same passes") {
    const Scene scene = streams();
    ReferenceEngine engine(scene);
    const MatchResult result = match_reference(engine, scene, {.frames = 8});
    CHECK(result.passed());
    CHECK(result.report().frames == 8);
    CHECK_THAT(result.text(), Contains("scene     x_streams (") && Contains("GL        an engine of its own\n") &&
                                  Contains("profile   strict: ") &&
                                  Contains("verdict   AGREE, but nothing collided: every bit"));
}

TEST_CASE("match_reference: one bit in one frame is found, with the line that repeats it") {
    const Scene scene = streams();
    ReferenceEngine engine(scene, speed_up);
    const MatchResult result = match_reference(engine, scene, {.frames = 8});
    CHECK_FALSE(result.passed());
    CHECK(result.report().verdict == Verdict::divergent);
    CHECK(result.report().first_frame == 3);
    CHECK_THAT(result.text(), Contains("verdict   DIVERGENT from frame 3 on") && Contains("frame 3 particle 7"));
    CHECK_THAT(repeat_command(result), StartsWith("cd ") && Contains("lockstep_tests_package"));
    ReferenceEngine again(scene, speed_up);
    CHECK(repeat_command(match_reference(again, scene, {.repeat = "make test"})) == "make test");
}

TEST_CASE("match_reference: mode and rules are the caller's") {
    const Scene scene = streams();
    ReferenceEngine free_engine(scene, speed_up);
    const MatchResult free = match_reference(free_engine, scene, {.frames = 8, .mode = CheckMode::free});
    CHECK(free.report().verdict == Verdict::differ);
    CHECK_FALSE(free.passed());
    ReferenceEngine legal_engine(scene, speed_up);
    const MatchResult legal = match_reference(legal_engine, scene, {.frames = 8, .legal = Legal::any_order});
    CHECK(legal.report().verdict == Verdict::legal);
    CHECK(legal.passed());
}

TEST_CASE("match_reference: where nothing collides, requiring hits fails") {
    const Scene scene = streams();
    ReferenceEngine engine(scene), again(scene);
    CHECK(match_reference(engine, scene, {.frames = 4}).passed());
    const MatchResult hit = match_reference(again, scene, {.frames = 4, .require_hits = true});
    CHECK_FALSE(hit.passed());
    CHECK_THAT(hit.text(), Contains("verdict   FAILED: nothing collided, expected a hit; AGREE: every bit"));
}

TEST_CASE("match_reference: where too few mistakes would have shown, a test that asks for more fails") {
    const Scene scene = streams();
    ReferenceEngine engine(scene), again(scene);
    CHECK(match_reference(engine, scene, {.frames = 4, .power_at_least = 0.2}).passed());
    const MatchResult result = match_reference(again, scene, {.frames = 4, .power_at_least = 0.95});
    CHECK_FALSE(result.passed());
    CHECK_THAT(result.text(), Contains("last_found_instead_of_nearest") && Contains("expected at least 95 %; AGREE"));
}

TEST_CASE("match_reference: what would prove nothing is an error") {
    const Scene scene = streams();
    ReferenceEngine engine(scene);
    CHECK_THROWS_WITH(match_reference(engine, scene, {.frames = 4, .power_at_least = 95}),
                      "power_at_least(95): a share is from 0 to 1, as 0.95");
    CHECK_THROWS_WITH(match_reference(engine, scene, {.frames = 0}),
                      "x_streams: nothing was compared: 0 frames of 300 particles");
}

TEST_CASE("match_reference: the report of a failed match is at most 60 lines") {
    const Scene scene = streams();
    ReferenceEngine engine(scene, [](int /*frame*/, Particles& particles) {
        for (glm::vec3& position : particles.position)
            position += 1.0F;
    });
    const MatchResult result = match_reference(engine, scene, {.frames = 1});
    const std::string wide = result.text();
    const std::string narrow = result.text(60);
    CHECK(std::count(wide.begin(), wide.end(), '\n') <= 60);
    CHECK(std::count(narrow.begin(), narrow.end(), '\n') <= 58);
    CHECK_THAT(narrow, Contains("\nrepeat    cd "));
}

TEST_CASE("gl: a context that is not there is told, and refuses shaders") {
    const Gl gl("egl-device:99");
    CHECK_FALSE(gl);
    CHECK_THAT(gl.missing(), StartsWith("no GL context: egl-device:99: "));
    const Scene scene = streams();
    CHECK_THROWS_WITH(UserShaders(gl, scene, ""), gl.missing());
}

TEST_CASE("gl: LOCKSTEP_GL is asked for where the caller asks for none") {
    setenv("LOCKSTEP_GL", "vulkan", 1);
    CHECK_THROWS_WITH(Gl(), Contains("vulkan") && Contains("osmesa"));
    setenv("LOCKSTEP_GL", "egl-device:99", 1);
    CHECK(Gl().asked() == "egl-device:99");
    unsetenv("LOCKSTEP_GL");
    CHECK(Gl("egl-device:98").asked() == "egl-device:98");
}

TEST_CASE("user shaders: a folder of which nothing runs is refused; without one lockstep's own run, and agree") {
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder folder;
    const Scene scene = streams();
    CHECK_THROWS_WITH(UserShaders(gl, scene, folder.path()), Contains("nothing in it would run in this scene"));
    UserShaders gpu(gl, scene, "");
    const MatchResult result = match_reference(gpu, scene, {.frames = 40});
    INFO(result.text());
    CHECK(result.passed());
    CHECK(result.report().hits > 0);
    CHECK_THAT(result.text(), Contains("GL        " + gl.name()) && Contains("shaders   shipped: collision_pass.vert"));
}

TEST_CASE("user shaders: what runs beside what does not, where that is allowed") {
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder folder;
    test::plant(folder, "collision_pass.vert", "// Lines 21 to 24.", "// Mine.");
    test::plant(folder, "octree_pass.comp", "writeonly buffer After", "writeonly buffer  After");
    const Scene scene = streams();
    CHECK_THROWS_WITH(UserShaders(gl, scene, folder.path()), Contains("octree_pass.comp would not run"));
    UserShaders gpu(gl, scene, folder.path(), UnusedShaders::allowed);
    const MatchResult result = match_reference(gpu, scene, {.frames = 2});
    CHECK_THAT(result.text(), Contains("shaders   foreign: " + (folder.path() / "collision_pass.vert").string()) &&
                                  Contains("; not run: octree_pass.comp\n"));
}

TEST_CASE("user shaders: a planted bug is found, and the last line of the report finds it again") {
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder folder;
    test::plant(folder, "collision_pass.vert", "v_CollideTime = u_CollisionTime;", "v_CollideTime = 0.0;");
    const Scene scene = streams();
    UserShaders gpu(gl, scene, folder.path());
    const MatchResult result = match_reference(gpu, scene, {.frames = 40});
    CHECK(result.report().verdict == Verdict::divergent);
    const std::string command = repeat_command(result);
    CHECK_THAT(command, StartsWith("lockstep check " + scene.origin + " --frames ") &&
                            EndsWith(" --gl " + test::software_gl() + " --shaders " + folder.path().string() +
                                     " --legal measured"));
    const test::ShellOutcome again = test::run_in_shell(command);
    CHECK(again.status == 1);
    CHECK_THAT(again.out, Contains("verdict   DIVERGENT from frame " + std::to_string(*result.report().first_frame)));
    CHECK_THAT(result.text(), Contains("again: lockstep explain " + scene.origin));
}

TEST_CASE("user shaders: a scene changed in code is not what the program would load") {
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder folder;
    test::plant(folder, "collision_pass.vert", "v_CollideTime = u_CollisionTime;", "v_CollideTime = 0.0;");
    Scene scene = streams();
    scene.constants.collision_time = 0.3F;
    scene.origin.clear();
    UserShaders gpu(gl, scene, folder.path());
    const MatchResult result = match_reference(gpu, scene, {.frames = 40});
    CHECK_THAT(result.text(), Contains("x_streams (made in code)"));
    CHECK_THAT(repeat_command(result), StartsWith("cd "));
}

TEST_CASE("user shaders: what the compiler says comes with file and line") {
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder folder;
    folder.write("collision_pass.vert", "#version 330 core\nvoid main() { gl_Position = nothing; }\n");
    const Scene scene = streams();
    CHECK_THROWS_WITH(UserShaders(gl, scene, folder.path()), Contains("collision_pass.vert:2"));
}

TEST_CASE("match_reference: with render the last frame is compared, too, and an engine has none") {
    const Scene scene = streams();
    ReferenceEngine engine(scene);
    CHECK_THROWS_WITH(match_reference(engine, scene, {.frames = 2, .render = true}),
                      Contains("an engine of its own draws no frame"));
    const Gl gl(test::software_gl());
    if (!gl)
        return test::skip(gl.missing());
    const test::TemporaryFolder right, wrong;
    test::plant(right, "render_pass.frag", "#version 330 core", "#version 330 core\n");
    test::plant(wrong, "render_pass.frag", "void main() {", "void main() { if (gl_FragCoord.x > 100.0) discard;");
    for (const auto* folder : {&right, &wrong}) {
        test::plant(*folder, "collision_pass.frag", "#version 330 core", "#version 330 core\n");
        UserShaders shaders(gl, scene, folder->path(), UnusedShaders::allowed);
        CHECK(match_reference(shaders, scene, {.frames = 4}).passed());
        const MatchResult result = match_reference(shaders, scene, {.frames = 4, .render = true});
        CHECK(result.passed() == (folder == &right));
        CHECK_THAT(result.text(),
                   Contains(folder == &right ? "render    AGREE: every one of" : "render    DIVERGENT: "));
    }
}

} // namespace lockstep::test::match_reference_test
