#pragma once
#include "gpu/shader_source.hpp"
#include "reference/model/clip_space.hpp"

namespace lockstep {

/// While it lives, GL clips, maps and tests depth as a host's clip space says: by glClipControl where z / w begins at
/// 0, and the greater depth is nearer where it is reversed. Throws Error where this GL has no glClipControl.
class HostDepth {
  public:
    explicit HostDepth(const ClipDepth& depth);
    ~HostDepth();
    HostDepth(const HostDepth&) = delete;
    HostDepth& operator=(const HostDepth&) = delete;

  private:
    bool from_zero_;
};

/// CLIP_DEPTH_FROM_ZERO where it is so, for clip_volume.glsl.
ShaderDefines clip_depth_defines(const ClipDepth& depth);

} // namespace lockstep
