#pragma once

namespace lockstep {

/// z / w at the near and at the far plane: GL has -1 and 1, Vulkan, D3D and WebGPU 0 and 1; reversed, the nearest has
/// the greater of the two.
struct ClipDepth {
    float near_plane = -1.0F;
    float far_plane = 1.0F;

    [[nodiscard]] constexpr bool from_zero() const { return near_plane == 0.0F || far_plane == 0.0F; }
    [[nodiscard]] constexpr bool reversed() const { return near_plane > far_plane; }

    /// The window depth is z / w * scale + offset; reversed, its negative, so that what is nearer is always less.
    [[nodiscard]] constexpr float scale() const { return (from_zero() ? 1.0F : 0.5F) * sign(); }
    [[nodiscard]] constexpr float offset() const { return from_zero() ? 0.0F : 0.5F * sign(); }
    [[nodiscard]] constexpr float sign() const { return reversed() ? -1.0F : 1.0F; }

    /// Of a depth buffer that is cleared to the far plane.
    [[nodiscard]] constexpr float cleared() const { return reversed() ? 0.0F : 1.0F; }

    /// Least z inside the clip volume, w being that.
    [[nodiscard]] constexpr float least(float w) const { return from_zero() ? 0.0F : -w; }

    bool operator==(const ClipDepth&) const = default;
};

/// How a host's clip space lies on the image.
struct ClipSpace {
    float first_row = -1.0F; ///< y / w at the image's first row in memory: -1 on GL and Vulkan, 1 on D3D and WebGPU
    ClipDepth depth;

    bool operator==(const ClipSpace&) const = default;
};

} // namespace lockstep
