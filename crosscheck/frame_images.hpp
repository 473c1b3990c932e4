#pragma once
#include <filesystem>

#include "crosscheck/check.hpp"

namespace lockstep {

/// Pictures of one frame of a check: the first that differs, or else the last.
class FrameImages {
  public:
    void keep(const ComparedFrame& frame);

    /// Writes DIR/cdt_reference.png, cdt_gpu.png, cdt_difference.png. All or none.
    void write(const std::filesystem::path& directory) const;

  private:
    int frame_ = -1;
    bool differs_ = false;
    Particles reference_, gpu_;
    CollisionImage reference_cdt_, gpu_cdt_;
};

} // namespace lockstep
