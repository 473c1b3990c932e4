#pragma once
#include <string_view>

#include "gpu/gl.hpp"

namespace lockstep {

/// Throws Error "WHAT: GL_INVALID_OPERATION" if GL has an error pending; clears it.
void check_gl(std::string_view what);

/// Throws Error naming the status unless the framebuffer bound to `target` is complete.
void check_framebuffer(GLenum target, std::string_view what);

} // namespace lockstep
