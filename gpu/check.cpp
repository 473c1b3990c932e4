#include "gpu/check.hpp"

#include <string>

#include <fmt/format.h>

#include "gpu/environment.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

#define LOCKSTEP_CASE(name)                                                                                            \
    case name:                                                                                                         \
        return #name

std::string error_name(GLenum error) {
    switch (error) {
        LOCKSTEP_CASE(GL_INVALID_ENUM);
        LOCKSTEP_CASE(GL_INVALID_VALUE);
        LOCKSTEP_CASE(GL_INVALID_OPERATION);
        LOCKSTEP_CASE(GL_INVALID_FRAMEBUFFER_OPERATION);
        LOCKSTEP_CASE(GL_OUT_OF_MEMORY);
        LOCKSTEP_CASE(GL_CONTEXT_LOST);
    default:
        return fmt::format("GL error {:#06x}", error);
    }
}

std::string status_name(GLenum status) {
    switch (status) {
        LOCKSTEP_CASE(GL_FRAMEBUFFER_UNDEFINED);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_UNSUPPORTED);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE);
        LOCKSTEP_CASE(GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS);
    default:
        return fmt::format("status {:#06x}", status);
    }
}

#undef LOCKSTEP_CASE

} // namespace

void check_gl(std::string_view what) {
    const GLenum first = gl::GetError();
    if (first == GL_NO_ERROR)
        return;
    // Every error flag is cleared, so that the next check speaks of its own calls. A lost context never ends.
    for (int i = 0; i < 16 && gl::GetError() != GL_NO_ERROR; ++i) {
    }
    const std::string limits = first == GL_OUT_OF_MEMORY ? tight_limits() : "";
    throw Error(fmt::format("{}: {}{}{}", what, error_name(first), limits.empty() ? "" : "; ", limits));
}

void check_framebuffer(GLenum target, std::string_view what) {
    const GLenum status = gl::CheckFramebufferStatus(target);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error(fmt::format("{}: framebuffer is not complete: {}", what, status_name(status)));
}

} // namespace lockstep
