#pragma once
#include <span>
#include <string>
#include <string_view>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// Where a shader declares a variable, for messages like a compiler's; GL itself does not tell.
struct Declaration {
    std::string place;           ///< FILE:LINE, or the first FILE where none is found
    bool is_initialised = false; ///< `uniform float u_Mine = 0.5;`
};

/// The first line of `stages` that declares `name` with `qualifier` (uniform, in, out).
Declaration find_declaration(std::span<const ShaderSource> stages, std::string_view qualifier, std::string_view name);

} // namespace lockstep
