#include <lockstep/catch.hpp>

#include "grains.hpp"

using namespace lockstep;

TEST_CASE("the grains step as their twin says") {
    const Gl gl;
    if (!gl)
        return skip(gl.missing());
    const System system = grains::system(2000);
    GlSystemSide gpu(gl, system, grains::passes(), SHADERS);
    const MatchResult result = match_system(gpu, system, {.frames = 60});
    INFO(result.text());
    CHECK(result.passed());
}
