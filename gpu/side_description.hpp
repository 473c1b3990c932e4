#pragma once
#include <optional>
#include <string>
#include <vector>

#include "gpu/shader_use.hpp"
#include "gpu/shader_warnings.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What a side tells of itself.
struct SideDescription {
    std::string name = "an engine of its own"; ///< what it runs on, one line: renderer, version, context
    Profile profile;                           ///< its driver's arithmetic, which the reference follows
    /// The options with which `lockstep check` runs it again ("--shaders mine"); not set: the program cannot.
    std::optional<std::string> arguments;
    std::optional<ShaderUse> shaders;         ///< whose shaders it runs; not set: not lockstep's and not told
    std::vector<ShaderWarning> warnings = {}; ///< of the driver, about them
};

} // namespace lockstep
