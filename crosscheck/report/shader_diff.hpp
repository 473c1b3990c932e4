#pragma once
#include <string>
#include <vector>

#include "gpu/shader_use.hpp"

namespace lockstep {

/// Lines of a user's shader that stand in the place of lines of the shipped one.
struct ShaderChange {
    int line = 1; ///< of the user's file, the first of `now`, or the one before which lines are gone
    std::vector<std::string> before, now;
};

/// What a user's file changes of the shipped one of its name, by the shortest edit script of lines (Wu, Manber, Myers
/// and Miller 1990); none where either is missing.
std::vector<ShaderChange> shader_changes(const UsedShader& used);

/// Where each user's shader differs from the shipped one, file and line, with both texts; of one that is mostly its own
/// only how many lines it shares. Empty: no file differs.
std::string shader_diff_text(const ShaderUse& use);

} // namespace lockstep
