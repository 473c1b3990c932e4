#pragma once
#include <cstddef>
#include <utility>

#include <CLI/CLI.hpp>

#include "reference/known_operations.hpp"
#include "reference/model/scene.hpp"

namespace lockstep {

/// What a difference is judged by.
enum class Legal {
    measured, ///< what the driver was measured to do, GLSL's rules for the rest
    glsl,     ///< GLSL's rules alone
    any_order ///< and + - * in any order, fused or not, for shaders without `precise`
};

void add_legal_option(CLI::App& verb, Legal& legal);

KnownOperations known_operations(Legal legal, const Profile& profile);

/// " --legal glsl", or nothing for measured.
std::string legal_option_text(Legal legal);

/// Throws Error if the scene has no such particle.
void check_particle(const Scene& scene, std::size_t particle);

/// Index of a texel, column and row. Throws Error if the CDT has none there.
std::size_t texel_index(const Scene& scene, std::pair<int, int> texel);

} // namespace lockstep
