#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <omp.h>

#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/golden.hpp"

namespace lockstep::test::golden_hash_test {

using test::Golden;

namespace {

/// The hash that the reference comes to; nothing without the scene's mesh.
std::optional<std::string> hash_of(const Golden& golden) {
    const std::optional<Scene> scene = golden.load();
    if (!scene)
        return std::nullopt;
    ReferenceSimulation reference(*scene, named_profile(golden.profile));
    for (int frame = 0; frame < golden.frames; ++frame)
        reference.step(frame_params(*scene, frame));
    return hash_text(state_hash(reference.particles(), reference.cdt()));
}

void check(const Golden& golden) {
    INFO(fmt::format("{}, {}, {}; if it was meant to change, scripts/golden_hashes.py", golden.scene, golden.preset,
                     golden.profile));
    if (const auto hash = hash_of(golden))
        CHECK(*hash == golden.hash);
}

} // namespace

TEST_CASE("golden hash: every shipped scene has its own") {
    CHECK(test::json_files("data/golden") == test::json_files("data/scenes"));
}

TEST_CASE("golden hash: every preset comes to it", "[levels]") {
    test::skip_missing_meshes();
    for (const Golden& golden : test::golden_hashes())
        if (golden.profile == (golden.preset == "paper" ? "llvmpipe" : "strict"))
            check(golden);
}

TEST_CASE("golden hash: one for every order of sums, which the exact preset does not depend on") {
    test::skip_missing_meshes();
    for (const Golden& golden : test::golden_hashes()) {
        if (golden.profile == (golden.preset == "paper" ? "strict" : "llvmpipe"))
            check(golden);
        for (const Golden& other : test::golden_hashes())
            if (other.scene == golden.scene && other.preset == golden.preset && other.profile != golden.profile)
                CHECK((other.hash == golden.hash) == (golden.preset == "exact"));
    }
}

TEST_CASE("golden hash: the same for 1, 2 and 4 threads") {
    test::skip_missing_meshes();
    const int before = omp_get_max_threads();
    for (const int threads : {1, 2, 4}) {
        omp_set_num_threads(threads);
        INFO(threads << " threads");
        for (const Golden& golden : test::golden_hashes())
            if (golden.preset == "corrected" && golden.profile == "llvmpipe")
                check(golden);
    }
    omp_set_num_threads(before);
}

} // namespace lockstep::test::golden_hash_test
