#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "gpu/collision/simulation.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/golden.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::golden_hash_twin_test {

TEST_CASE("golden hash twin: the shaders come to it by themselves") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::skip_missing_meshes();
    for (const test::Golden& golden : test::golden_hashes()) {
        const std::optional<Scene> scene = golden.profile == "llvmpipe" ? golden.load() : std::nullopt;
        if (!scene)
            continue;
        INFO(fmt::format("{}, {}", golden.scene, golden.preset));
        // A driver that sums in other orders comes to what the reference does with these; in `exact` to the same.
        std::string expected = golden.hash;
        if (const Profile profile = test::llvmpipe_profile();
            profile.name != "llvmpipe" && scene->switches.arithmetic == ArithmeticSwitch::plain) {
            ReferenceSimulation reference(*scene, profile);
            for (int frame = 0; frame < golden.frames; ++frame)
                reference.step(frame_params(*scene, frame));
            expected = hash_text(state_hash(reference.particles(), reference.cdt()));
        }
        GpuSimulation gpu(*scene, {});
        for (int frame = 0; frame < golden.frames; ++frame)
            gpu.step(frame_params(*scene, frame));
        Particles particles;
        CollisionImage cdt;
        gpu.read(particles);
        gpu.read(cdt);
        CHECK(hash_text(state_hash(particles, cdt)) == expected);
    }
}

} // namespace lockstep::test::golden_hash_twin_test
