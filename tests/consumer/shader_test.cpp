#include <lockstep/catch.hpp>

using namespace lockstep;

namespace {

const Gl& gl() {
    static const Gl one;
    return one;
}

void check_shaders(const char* folder) {
    if (!gl())
        return skip(gl().missing());
    const Scene scene = load_scene(shipped_scene("x_streams"), {.particles = 10000});
    UserShaders gpu(gl(), scene, folder);
    CHECK_THAT(gpu, MatchesReference(scene).frames(60));
}

} // namespace

TEST_CASE("the collision pass answers to the nearest particle") { check_shaders(SHADERS); }

TEST_CASE("a collision pass that answers to the last particle found", "[.broken]") { check_shaders(BROKEN_SHADERS); }
