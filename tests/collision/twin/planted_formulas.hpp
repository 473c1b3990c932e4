#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include "crosscheck/scene/scene_file.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/told_causes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

/// Shipped shaders with another formula in one place.
namespace lockstep::test::formulas {

/// A formula of a stage's, and the one that stands there instead.
struct Plant {
    std::string cause, scene, text, replacement, file = "collision_pass.vert";
};

inline const std::string in_range = "u_CollisionRange > len && len < particle_min_length";
inline const std::string w_of_neighbour = "ls_transform(u_ProjView, decode_position(stored)).w";
inline const std::string w_of_own = "ls_transform(u_ProjView, a_Position).w";
inline const std::string hit_position = "    v_Position = sum(a_Position, step);\n";
inline const std::string moved = R"(
    step = product(v_Dir, v_Speed);
#if COLLISION_STEP == COLLISION_STEP_TICK
    step = product(step, u_Tick);
#endif
    v_Position = sum(a_Position, step);)";
inline const std::string hit = "        collide(away);\n    else\n        integrate();";

/// The neighbour in range with the least `key` is taken.
inline Plant least(const std::string& cause, const std::string& scene, const std::string& key) {
    return {cause, scene, "            if (" + in_range + ") {\n                particle_min_length = len;",
            "            if (u_CollisionRange > len && " + key +
                " < particle_min_length) {\n"
                "                particle_min_length = " +
                key + ";"};
}
/// Texels for which `condition` holds are skipped, and no others.
inline Plant skips(const std::string& cause, const std::string& condition) {
    return {cause, "crowd", "(tx == 0 && ty == 0)", "(" + condition + ")"};
}
/// At a hit, `statement` follows.
inline Plant after_hit(const std::string& cause, const std::string& statement) {
    return {cause, "crowd", hit_position, hit_position + "    " + statement + "\n"};
}
/// In free fall, `statement` follows.
inline Plant after_fall(const std::string& cause, const std::string& statement) {
    return {cause, "crowd", hit,
            "        collide(away);\n    else {\n        integrate();\n        " + statement + "\n    }"};
}

inline void check_told(const std::vector<Plant>& plants) {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const Plant& plant : plants) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, plant.file, plant.text, plant.replacement);
        const Scene scene = load_scene("data/scenes/stress/" + plant.scene + ".json", {});
        const CheckReport report = test::check_twins(scene, 8, shaders.path());
        const std::vector<std::string> told = test::told_causes(report);
        INFO(plant.cause << ": " << verdict_name(report.verdict)
                         << ", told: " << fmt::format("{}", fmt::join(told, " ")));
        CHECK(report.verdict == Verdict::divergent);
        CHECK(std::find(told.begin(), told.end(), plant.cause) != told.end());
    }
}

} // namespace lockstep::test::formulas
