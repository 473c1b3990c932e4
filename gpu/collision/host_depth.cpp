#include "gpu/collision/host_depth.hpp"

#include "gpu/gl.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

HostDepth::HostDepth(const ClipDepth& depth) : from_zero_(depth.from_zero()) {
    if (from_zero_ && gl::ClipControl == nullptr)
        throw Error("clip_space: depth from 0 needs glClipControl, which this GL lacks (4.5 or GL_ARB_clip_control)");
    if (from_zero_)
        gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(depth.reversed() ? GL_GREATER : GL_LESS);
}

HostDepth::~HostDepth() {
    if (from_zero_)
        gl::ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl::DepthFunc(GL_LESS);
}

ShaderDefines clip_depth_defines(const ClipDepth& depth) {
    return depth.from_zero() ? ShaderDefines{{"CLIP_DEPTH_FROM_ZERO", "1"}} : ShaderDefines{};
}

} // namespace lockstep
