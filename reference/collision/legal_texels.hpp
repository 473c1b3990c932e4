#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reference/collision/legal_outcomes.hpp"
#include "reference/legal_triangles.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"
#include "reference/tie.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// A driver draws a point whose centre lies outside the view volume, which departs from GL (4.5, 13.5); the shader is
/// right. Margin: how far outside it lies.
inline constexpr TieKind outside_tie{"the driver draws points outside the view volume", "/256 pixel"};

/// Who may have been drawn to a texel last.
struct TexelOwner {
    enum class Kind { nothing, obstacle, particle };
    Kind kind = Kind::nothing;
    std::size_t index = 0; ///< particle; triangle or vertex of the obstacles
    glm::vec4 code{0.0F};  ///< what it stores (image.hpp)
    /// Codes between which each component may lie: an obstacle's interpolated position, or what a driver makes of plain
    /// floats. Not set: exactly `code`.
    std::optional<std::pair<glm::vec4, glm::vec4>> code_range = std::nullopt;
    bool is_reference = false;    ///< the one that the reference leaves here
    float reference_depth = 1.0F; ///< as the reference computes it
    bool sure = true;             ///< drawn to this texel whatever the rounding
    double edge_margin = 0.0; ///< its point, or the texel's centre and its triangle's side: 1/256 pixel to the border
    /// Clip z and w of a point: the same two give the same depth, whatever the rounding.
    std::optional<glm::vec2> clip_zw = std::nullopt;
    Interval depth{1.0F, 1.0F}; ///< window depth

    /// Where a shift of everything points that makes the GPU decide otherwise here: for a point, from the pixel of the
    /// reference to this one; for a triangle's side, outward where the reference does not cover the texel, else inward.
    glm::dvec2 shift{0.0};
    bool is_side = false;            ///< `shift` is a side's normal
    bool drawn_by_reference = false; ///< to this texel, be it hidden there
    std::uint64_t place = 0;         ///< the same for the same window position of a point, or texel of a triangle
    PixelRect reach = {};            ///< of a point: the pixels it may land on, the image's and those beside it
    bool may_be_clipped = false;     ///< of a point: it may lie outside the clip volume
    /// Of a point that GL drops for certain and a driver may draw all the same: 1/256 pixel from its centre to the view
    /// volume.
    std::optional<double> outside = std::nullopt;

    [[nodiscard]] bool stores(glm::vec4 texel) const;
};

/// The owners of one texel that GL allows, never none. With more than one, rounding decides.
struct LegalTexel {
    std::vector<TexelOwner> owners;

    /// The legal owner that stores these bits, the reference's first; null: nobody legal does.
    [[nodiscard]] const TexelOwner* owner_of(glm::vec4 texel) const;
    /// Why it may win against the one the reference draws.
    [[nodiscard]] std::vector<Tie> ties(const TexelOwner& owner) const;
};

/// A frame in which texels are asked for, more than once: what every question needs is found once. Refers to the run's
/// own data.
class DrawnFrame {
  public:
    const Mesh& obstacles;
    const Particles& before;
    const Particles& after;
    const FrameParams& params;
    const Profile& profile;

    /// `texels_of_points`: where the reference draws each of points(), no_texel: nowhere; empty: nobody has found it.
    DrawnFrame(const Mesh& obstacles_drawn, const Particles& from, const Particles& to, const FrameParams& frame_params,
               const Profile& followed, std::span<const std::int32_t> texels_of_points = {})
        : obstacles(obstacles_drawn), before(from), after(to), params(frame_params), profile(followed),
          texels_of_points_(texels_of_points) {}

    /// Positions that are drawn: the switch raster_position.
    [[nodiscard]] std::span<const glm::vec3> points() const;
    /// In ascending order all points that the reference draws to one of `texels`, next to one, or nowhere; and others.
    [[nodiscard]] std::span<const std::uint32_t> points_near(std::span<const std::size_t> texels) const;
    [[nodiscard]] std::span<const std::int32_t> texels_of_points() const;
    /// The obstacles' triangles in the subnormal mode `flush`; `project` gives their corners.
    template <class Project> const AssembledTriangles& triangles(bool flush, const Project& project) const {
        if (!triangles_ || flushed_ != flush)
            triangles_.emplace(project(), obstacles.indices, params.width, params.height, profile.raster,
                               params.clip_depth);
        flushed_ = flush;
        return *triangles_;
    }

  private:
    mutable std::span<const std::int32_t> texels_of_points_;
    mutable std::unique_ptr<std::int32_t[]> found_texels_; ///< never written before many threads do
    mutable Image<std::uint8_t> near_;                     ///< 1: points drawn there are among near_points_
    mutable std::vector<std::uint32_t> near_points_;
    mutable std::optional<AssembledTriangles> triangles_;
    mutable bool flushed_ = false;
};

/// For each of `texels` (indices into the CDT), who may own it after `after` was drawn over the obstacles: points whose
/// window position may fall there, triangles whose sides pass the texel's centre, depths that rounding can swap.
/// Each rule that is known (KnownRaster) is the reference's. Of the others: a window coordinate is what operations give
/// that are accurate to 1 part in 10^5 (GL 4.5, 2.3.4.1), or as GLSL's are where that was measured; a grid that is not
/// known moves it by up to one step, which is at most 1/16 pixel (SUBPIXEL_BITS, table 23.53); what lies on a pixel's
/// edge may belong to either side. A point whose centre lies beside the view volume may be drawn where the grid puts
/// it, unless the probe found that such points are dropped (brink_rows).
std::vector<LegalTexel> legal_texels(const DrawnFrame& frame, const KnownOperations& known,
                                     std::span<const std::size_t> texels);
std::vector<LegalTexel> legal_texels(const Mesh& obstacles, const Particles& before, const Particles& after,
                                     const FrameParams& params, const Profile& profile, const KnownOperations& known,
                                     std::span<const std::size_t> texels);

} // namespace lockstep
