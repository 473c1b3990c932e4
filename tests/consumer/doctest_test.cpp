#include <lockstep/doctest_main.hpp>

#include <lockstep/doctest.hpp>
#include <lockstep/function_table.hpp>

using namespace lockstep;

namespace {

const Gl& gl() {
    static const Gl one;
    return one;
}

MatchResult match(const char* folder) {
    const Scene scene = load_scene(shipped_scene("x_streams"), {.particles = 3000});
    UserShaders gpu(gl(), scene, folder);
    return match_reference(gpu, scene, {.frames = 30});
}

} // namespace

TEST_CASE("shaders answer to the nearest") {
    if (!gl())
        return skip(gl().missing());
    LOCKSTEP_CHECK(match(SHADERS));
}

TEST_CASE("a wall keeps half") {
    if (!gl())
        return skip(gl().missing());
    const GlslFunction bounce{"wall.glsl", "bounce", {{"u_Kept", 0.5F}}};
    LOCKSTEP_REQUIRE(match_function(gl(), bounce, read_function_rows(bounce, "walls.csv")));
}

TEST_CASE("shaders answer to the last" * doctest::skip()) {
    LOCKSTEP_REQUIRE(match(BROKEN_SHADERS));
    FAIL("nobody comes by here");
}
