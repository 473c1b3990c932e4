#pragma once
#include <array>
#include <cmath>
#include <optional>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/clip_space.hpp"

namespace lockstep {

/// To 0..high; NaN becomes 0.
inline float clamp_to(float x, float high) { return x > 0.0F ? (x < high ? x : high) : 0.0F; }

/// Coverage and perspective-correct interpolation of a triangle in homogeneous coordinates (Olano and Greer, "Triangle
/// scan conversion using 2D homogeneous coordinates", 1997), at pixel centres and in a written order of operations.
/// Twin of shaders/triangle_interpolation.glsl: the fragment shader gets the whole triangle and interpolates by itself,
/// so that nothing depends on the driver's interpolator, nor, in the exact preset, on its rasteriser. `A`:
/// arithmetic.hpp.
template <class A> class TriangleInterpolation {
  public:
    /// Shares of the second and third corner; the first has the rest. Both >= 0, their sum <= 1: a centre that is
    /// covered only because corners were snapped gets the nearest share inside.
    struct Weights {
        float second = 0.0F;
        float third = 0.0F;
    };

    /// Edge functions of the sides opposite to the corners: their shares times `sum`. Two triangles that share a side
    /// see its edge function with the same bits but for the sign, and the sign is right or the result 0: rounding keeps
    /// the order of the two products.
    struct Edges {
        float first = 0.0F;
        float second = 0.0F;
        float third = 0.0F;
        float sum = 0.0F;
    };

    /// A pixel that the triangle covers, and its window depth.
    struct Fragment {
        Weights weights;
        float depth = 0.0F;
    };

    TriangleInterpolation(A fp, const std::array<glm::vec4, 3>& clip, int width, int height,
                          const ClipDepth& depth = {})
        : fp_(fp), clip_(clip), width_(width), height_(height), depth_(depth) {
        for (std::size_t i = 0; i < 3; ++i) {
            x_[i] = clip[i].x * static_cast<float>(width);
            y_[i] = clip[i].y * static_cast<float>(height);
        }
    }

    /// At the centre of pixel (x, y).
    [[nodiscard]] Edges edges(int x, int y) const { return edges_at(2 * x + 1 - width_, 2 * y + 1 - height_); }

    /// At a place in half pixels from the image's middle. Corners are taken relative to it, in half pixels times w:
    /// what cancels cancels before anything is multiplied, which keeps triangles of a pixel's size accurate.
    [[nodiscard]] Edges edges_at(int half_pixels_x, int half_pixels_y) const {
        const auto centre_x = static_cast<float>(half_pixels_x);
        const auto centre_y = static_cast<float>(half_pixels_y);
        std::array<float, 3> rx{}, ry{};
        for (std::size_t i = 0; i < 3; ++i) {
            rx[i] = fp_.flush(x_[i] - centre_x * clip_[i].w);
            ry[i] = fp_.flush(y_[i] - centre_y * clip_[i].w);
        }
        const auto edge = [&](std::size_t from, std::size_t to) {
            return fp_.flush(fp_.flush(rx[from] * ry[to]) - fp_.flush(rx[to] * ry[from]));
        };
        const float first = edge(1, 2);
        const float second = edge(2, 0);
        const float third = edge(0, 1);
        return {first, second, third, fp_.flush((first + second) + third)};
    }

    [[nodiscard]] Weights weights(const Edges& edges) const {
        if (!(edges.sum < 0.0F) && !(edges.sum > 0.0F))
            return {};
        const float second_share = clamp_to(fp_.divide(edges.second, edges.sum), 1.0F);
        return {second_share, clamp_to(fp_.divide(edges.third, edges.sum), 1.0F - second_share)};
    }

    [[nodiscard]] Weights weights(int x, int y) const { return weights(edges(x, y)); }

    /// Window depth, as ClipDepth has it.
    [[nodiscard]] float depth(const Weights& w) const { return depth_.sign() * clamp_to(depth_unclamped(w), 1.0F); }

    /// The exact preset's own coverage of pixel (x, y). The triangle is closed, so triangles that share a side leave no
    /// gap: a centre on the side belongs to both, and the depth test decides. Nothing where it is seen edge-on, behind
    /// the camera or beyond the near or far plane.
    [[nodiscard]] std::optional<Fragment> fragment(int x, int y) const {
        const Edges e = edges(x, y);
        if (e.sum == 0.0F || !std::isfinite(e.sum))
            return {};
        const bool counterclockwise = e.first >= 0.0F && e.second >= 0.0F && e.third >= 0.0F;
        const bool clockwise = e.first <= 0.0F && e.second <= 0.0F && e.third <= 0.0F;
        if (!counterclockwise && !clockwise)
            return {};
        const Weights w = weights(e);
        const float window_depth = depth_unclamped(w);
        if (!(mix(fp_, clip_[0].w, clip_[1].w, clip_[2].w, w) > 0.0F) ||
            !(window_depth >= 0.0F && window_depth <= 1.0F))
            return {};
        return Fragment{w, depth_.sign() * window_depth};
    }

    [[nodiscard]] static glm::vec3 mix(A fp, const std::array<glm::vec3, 3>& p, const Weights& w) {
        return {mix(fp, p[0].x, p[1].x, p[2].x, w), mix(fp, p[0].y, p[1].y, p[2].y, w),
                mix(fp, p[0].z, p[1].z, p[2].z, w)};
    }

  private:
    [[nodiscard]] float depth_unclamped(const Weights& w) const {
        const float clip_z = mix(fp_, clip_[0].z, clip_[1].z, clip_[2].z, w);
        const float clip_w = mix(fp_, clip_[0].w, clip_[1].w, clip_[2].w, w);
        const float ndc = fp_.divide(clip_z, clip_w);
        return depth_.from_zero() ? ndc : ndc * 0.5F + 0.5F;
    }

    static float mix(A fp, float first, float second, float third, const Weights& w) {
        const float towards_second = fp.flush(w.second * fp.flush(second - first));
        const float towards_third = fp.flush(w.third * fp.flush(third - first));
        return fp.flush(fp.flush(first + towards_second) + towards_third);
    }

    A fp_;
    std::array<glm::vec4, 3> clip_;
    std::array<float, 3> x_{}, y_{};
    int width_, height_;
    ClipDepth depth_;
};

/// By how much a component of an interpolated position may differ where a driver's division is not correctly rounded.
/// + - * are (GLSL 4.50, 4.7.1), so the two quotients are all that differs: 2.5 ULP there and half an ULP here make
/// 3 * 2^-23 of a share, a share being at most 1; the clamp of the third share hands on the second's difference and a
/// rounding, so both are within 4 * 2^-23. With d1 = second - first and d2 = third - first, the exact result then moves
/// by 4 * 2^-23 (|d1| + |d2|). The two products, rounded on either side by half an ULP, add 2^-23 (|d1| + |d2|), the
/// two sums 2^-23 each of a value that lies between the corners: at most the largest |corner|, here taken three times
/// for what was rounded before. Together 2^-23 (5 (|d1| + |d2|) + 3 max|corner|).
inline float interpolation_bound(float first, float second, float third) {
    const auto magnitude = [](float x) { return x < 0.0F ? -x : x; };
    float largest = magnitude(first);
    largest = magnitude(second) > largest ? magnitude(second) : largest;
    largest = magnitude(third) > largest ? magnitude(third) : largest;
    return 0x1p-23F * (5.0F * (magnitude(second - first) + magnitude(third - first)) + 3.0F * largest);
}

} // namespace lockstep
