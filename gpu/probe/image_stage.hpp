#pragma once
#include <span>
#include <string>

#include "gpu/probe/images.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {

/// A fragment shader over every texel of an image, fed from textures u_A and u_B of the same size.
class ImageStage {
  public:
    explicit ImageStage(const std::string& fragment_shader);

    [[nodiscard]] const Program& program() const { return program_; }

    /// Draws into `targets`, all of width x height texels.
    void run(int width, int height, std::span<const GlTexture* const> sources,
             std::span<const GlTexture* const> targets) const;

  private:
    Program program_;
};

} // namespace lockstep::probing
