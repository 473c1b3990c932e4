#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "reference/model/fluid/settings.hpp"
#include "reference/model/profile.hpp"

namespace lockstep::fluid {

/// One pass of the filter: along an axis, or over a plane of samples.
struct FilterStep {
    enum class Shape : std::uint8_t { along, plane };
    Shape shape = Shape::along;
    glm::ivec2 direction{1, 0}; ///< of along
    bool of_spheres = false;    ///< reads the depth of the spheres; else what the step before left
};

/// How twins take gl_PointCoord to be made (point_coord.hpp).
enum class PointCoord : std::uint8_t { accurate, cut, open };

/// What twins take to become of a point whose middle lies outside the view volume. GL drops it (4.5, 13.5). Some
/// drivers draw it if the middle lies beside the image alone. Open: each such point may be drawn or not.
enum class PointsOutside : std::uint8_t { dropped, drawn_beside, open };

/// What a driver makes of points.
struct PointRules {
    PointCoord coord = PointCoord::accurate;
    PointsOutside outside = PointsOutside::dropped;
    PointSizes sizes = {};

    bool operator==(const PointRules&) const = default;
};

/// How twins take GL_LINEAR to be made: with weights of all bits, in fixed point (reference/aligned_filter.hpp), or
/// with any weights of 8 bits.
enum class LinearFilter : std::uint8_t { all_bits, aligned, open };

/// What the host hands the passes: made in double, rounded once. Immutable.
class Host {
  public:
    /// Throws Error as check() does.
    explicit Host(Settings settings, PointRules points = {}, LinearFilter filter = LinearFilter::all_bits);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const Switches& switches() const { return settings_.switches; }

    [[nodiscard]] const PointRules& points() const { return points_; }
    [[nodiscard]] LinearFilter linear_filter() const { return linear_filter_; }

    [[nodiscard]] const glm::mat4& view() const { return view_; }
    [[nodiscard]] const glm::mat4& projection() const { return projection_; }
    [[nodiscard]] const glm::mat4& view_projection() const { return view_projection_; }
    [[nodiscard]] const glm::mat4& inverse_view() const { return inverse_view_; }
    [[nodiscard]] glm::vec2 slope() const { return slope_; } ///< 1 / P00, 1 / P11
    /// A and B: clip z = A z + B.
    [[nodiscard]] glm::vec2 depth_coefficients() const { return {projection_[2][2], projection_[3][2]}; }
    [[nodiscard]] float near_plane() const { return settings_.camera.near_plane; }
    /// 2^-k, 2^k the least power of two that is far or farther: what a depth in metres is tested by.
    [[nodiscard]] float depth_scale() const { return depth_scale_; }
    [[nodiscard]] glm::vec2 screen_size() const { return {settings_.width, settings_.height}; }

    [[nodiscard]] float point_scale() const { return point_scale_; } ///< pixels times w: a sprite's size over r
    [[nodiscard]] float thickness_radius() const { return thickness_radius_; } ///< m
    [[nodiscard]] float thickness_gain() const { return thickness_gain_; }     ///< added in a sprite's middle

    [[nodiscard]] float blur_scale() const { return blur_scale_; }   ///< beta, 1 / pixel
    [[nodiscard]] float range_scale() const { return range_scale_; } ///< phi, of what is filtered
    /// exp(-(j beta)^2) of j = 0 to 31.
    [[nodiscard]] const std::array<float, most_filter_radius + 1>& weights() const { return weights_; }
    [[nodiscard]] float narrow_scale() const { return narrow_scale_; } ///< pixels times m: a radius over 1 / |z|
    [[nodiscard]] float narrow_delta() const { return 10.0F * settings_.radius; }
    [[nodiscard]] float narrow_mu() const { return settings_.radius; }
    [[nodiscard]] glm::vec2 flow_scale() const { return flow_scale_; } ///< Cx, Cy
    [[nodiscard]] float flow_reach() const { return 5.0F * settings_.radius; }
    /// The filter's passes, in order; none where it is off.
    [[nodiscard]] const std::vector<FilterStep>& filter_steps() const { return filter_steps_; }

    /// Whether particles are elsewhere in some frame than at the start.
    [[nodiscard]] bool moves() const { return settings_.wave || !settings_.recording.empty(); }
    /// Where they are in a frame: four floats each, the last 1.
    [[nodiscard]] std::vector<float> positions(int frame) const;

  private:
    Settings settings_;
    PointRules points_;
    LinearFilter linear_filter_;
    glm::mat4 view_{1.0F}, projection_{1.0F}, view_projection_{1.0F}, inverse_view_{1.0F};
    glm::vec2 slope_{1.0F}, flow_scale_{1.0F};
    float depth_scale_ = 1.0F, point_scale_ = 1.0F, thickness_radius_ = 0.0F, thickness_gain_ = 0.0F,
          blur_scale_ = 0.0F, range_scale_ = 0.0F, narrow_scale_ = 0.0F;
    std::array<float, most_filter_radius + 1> weights_{};
    std::vector<FilterStep> filter_steps_;
};

using HostPtr = std::shared_ptr<const Host>;

// Constants of the published shading, for both sides.
inline constexpr std::array<float, 4> fluid_colour{0.275F, 0.75F, 0.85F, 0.8F}; ///< r g b, alpha
inline constexpr std::array<float, 3> scene_sky{0.5F, 0.625F, 0.75F};
inline constexpr float depth_codes = 16777215.0F; ///< of 24 bits

} // namespace lockstep::fluid
