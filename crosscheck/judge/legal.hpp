#pragma once
#include <string>

#include "reference/known_operations.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What a difference is judged by.
enum class Legal {
    measured,  ///< what the driver was measured to do, GLSL's rules for the rest
    glsl,      ///< GLSL's rules alone
    any_order, ///< and + - * in any order, fused or not, for shaders without `precise`
    by_text    ///< measured, and what a shader's own text leaves open
};

KnownOperations known_operations(Legal legal, const Profile& profile);

/// " --legal glsl", or nothing for by_text.
std::string legal_option_text(Legal legal);

} // namespace lockstep
