#include "reference/legal_texels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "reference/collision_code.hpp"
#include "reference/collision_pass.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

using Kind = TexelOwner::Kind;

double middle(Interval v) { return (v.low + v.high) * 0.5; }

/// The texels asked for, by their place in the image.
class Wanted {
  public:
    Wanted(int width, int height, std::span<const std::size_t> texels) : slots_(width, height, -1) {
        for (std::size_t i = 0; i < texels.size(); ++i)
            slots_.texels[texels[i]] = static_cast<std::int32_t>(i);
    }
    [[nodiscard]] int slot(int x, int y) const { return slots_.contains(x, y) ? slots_.at(x, y) : -1; }
    /// Whether this texel or one of the eight around it is asked for.
    [[nodiscard]] bool near(int x, int y) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (slot(x + dx, y + dy) >= 0)
                    return true;
        return false;
    }

  private:
    Image<std::int32_t> slots_;
};

/// Pixels of one axis that a point may cover.
struct PixelRange {
    int first = 0, last = -1;
    double edge_margin = 0.0; ///< 1/256 pixel
};

/// A point's square of side 1 covers the centres inside; which of two on its border is open.
PixelRange pixels_of(Interval window, double snap) {
    const double low = window.low - snap;
    const double high = window.high + snap;
    const double centre = middle(window);
    return {static_cast<int>(std::ceil(low)) - 1, static_cast<int>(std::floor(high)),
            std::abs(centre - std::round(centre)) * 256.0};
}

/// ULP of a coordinate over w: a reciprocal of 2.5, a product, and what they make of each other's last place.
constexpr double divide_by_w = 4.0;
constexpr double viewport_operation = 1.0;

Interval window_coordinate(Interval clip, Interval w, double scale, double offset) {
    const Interval ndc = interval::widen(interval::divide(clip, w), divide_by_w);
    const Interval scaled = interval::widen(interval::multiply(ndc, {scale, scale}), viewport_operation);
    const Interval moved = interval::add(scaled, {offset, offset});
    const double magnitude = std::max({std::abs(scaled.low), std::abs(scaled.high), std::abs(offset)});
    const double error = viewport_operation * interval::ulp(magnitude);
    return moved.any ? moved : interval::outward(moved.low - error, moved.high + error);
}

enum class InVolume { no, maybe, yes };

InVolume in_clip_volume(const std::array<Interval, 4>& clip) {
    const Interval w = clip[3];
    if (w.any || !(w.high > 0.0))
        return InVolume::no;
    InVolume result = w.low > 0.0 ? InVolume::yes : InVolume::maybe;
    for (std::size_t c = 0; c < 3; ++c) {
        if (clip[c].any)
            return InVolume::no;
        const double least = clip[c].contains_zero() ? 0.0 : std::min(std::abs(clip[c].low), std::abs(clip[c].high));
        const double most = std::max(std::abs(clip[c].low), std::abs(clip[c].high));
        if (least > w.high)
            return InVolume::no;
        if (most > w.low)
            result = InVolume::maybe;
    }
    return result;
}

/// Collects the candidates of every wanted texel, in drawing order.
template <class A> class Candidates {
  public:
    Candidates(A fp, const FrameParams& params, const Profile& profile, const KnownOperations& known,
               std::span<const std::size_t> texels)
        : fp_(fp), params_(params), profile_(profile), code_(params), arithmetic_(fp, known),
          wanted_(params.width, params.height, texels), candidates_(texels.size()) {}

    void add_point(Kind kind, std::size_t index, glm::vec3 drawn_at, glm::vec3 stored) {
        const PointFragment reference = point_fragment(drawn_at, params_, profile_);
        const bool drawn = reference.x >= 0;
        if (drawn && !wanted_.near(reference.x, reference.y))
            return;
        TexelOwner owner{.kind = kind, .index = index, .code = code_.encode(stored)};
        owner.reference_depth = reference.depth;
        if (arithmetic_.known().points) {
            owner.is_reference = true;
            owner.depth = reference.depth;
            if (drawn)
                add(owner, reference.x, reference.y);
            return;
        }
        const auto clip = arithmetic_.transform(params_.collision_proj_view, arithmetic_.read(drawn_at));
        const InVolume inside = in_clip_volume(clip);
        if (inside == InVolume::no || clip[3].contains_zero())
            return;
        const double snap = std::ldexp(1.0, -profile_.raster.subpixel_bits);
        const double half_width = params_.width * 0.5;
        const double half_height = params_.height * 0.5;
        const PixelRange columns = pixels_of(window_coordinate(clip[0], clip[3], half_width, half_width), snap);
        const PixelRange rows = pixels_of(window_coordinate(clip[1], clip[3], half_height, half_height), snap);
        owner.depth = window_coordinate(clip[2], clip[3], 0.5, 0.5);
        if (clip[2].is_point() && clip[3].is_point())
            owner.clip_zw = glm::vec2(clip[2].as_float(), clip[3].as_float());
        owner.sure = inside == InVolume::yes && columns.first == columns.last && rows.first == rows.last;
        owner.edge_margin = HUGE_VAL;
        if (columns.first != columns.last)
            owner.edge_margin = columns.edge_margin;
        if (rows.first != rows.last)
            owner.edge_margin = std::min(owner.edge_margin, rows.edge_margin);
        for (int y = rows.first; y <= rows.last; ++y)
            for (int x = columns.first; x <= columns.last; ++x) {
                owner.is_reference = x == reference.x && y == reference.y;
                add(owner, x, y);
            }
    }

    void add_triangles(const Mesh& obstacles) {
        std::vector<glm::vec4> clip(obstacles.positions.size());
        std::transform(obstacles.positions.begin(), obstacles.positions.end(), clip.begin(),
                       [&](glm::vec3 p) { return fp_.transform(params_.collision_proj_view, p); });
        for (const RasterTriangle& triangle :
             assemble_triangles(clip, obstacles.indices, params_.width, params_.height, profile_.raster))
            add_triangle(obstacles, clip, triangle);
    }

    std::vector<std::vector<TexelOwner>> take() { return std::move(candidates_); }

  private:
    void add(const TexelOwner& owner, int x, int y) {
        if (const int slot = wanted_.slot(x, y); slot >= 0)
            candidates_[static_cast<std::size_t>(slot)].push_back(owner);
    }

    void add_triangle(const Mesh& obstacles, const std::vector<glm::vec4>& clip, const RasterTriangle& triangle) {
        const auto& c = triangle.corners;
        const int bits = profile_.raster.subpixel_bits;
        const int x0 = std::min({c[0].x, c[1].x, c[2].x}) >> bits;
        const int y0 = std::min({c[0].y, c[1].y, c[2].y}) >> bits;
        const int x1 = (std::max({c[0].x, c[1].x, c[2].x}) >> bits) + 1;
        const int y1 = (std::max({c[0].y, c[1].y, c[2].y}) >> bits) + 1;
        for (int y = std::max(y0, 0); y <= std::min(y1, params_.height - 1); ++y)
            for (int x = std::max(x0, 0); x <= std::min(x1, params_.width - 1); ++x)
                if (wanted_.slot(x, y) >= 0)
                    add_pixel(obstacles, clip, triangle, x, y);
    }

    void add_pixel(const Mesh& obstacles, const std::vector<glm::vec4>& clip, const RasterTriangle& triangle, int x,
                   int y) {
        bool covered = false;
        for_each_pixel(triangle, profile_.raster, {x, y, x + 1, y + 1}, [&](int, int) { covered = true; });
        const bool exact = arithmetic_.known().points;
        const double margin = exact ? HUGE_VAL : side_distance(triangle, x, y, profile_.raster);
        constexpr double snap = 1.0;
        if (!covered && margin > snap)
            return;
        const std::uint32_t* index = &obstacles.indices[std::size_t{triangle.primitive} * 3];
        const std::array<glm::vec4, 3> corners{clip[index[0]], clip[index[1]], clip[index[2]]};
        const std::array<glm::vec3, 3> positions{obstacles.positions[index[0]], obstacles.positions[index[1]],
                                                 obstacles.positions[index[2]]};
        const TriangleInterpolation interpolation(fp_, corners, params_.width, params_.height);
        const auto weights = interpolation.weights(x, y);
        TexelOwner owner{.kind = Kind::obstacle, .index = triangle.primitive};
        const glm::vec3 position = interpolation.mix(fp_, positions, weights);
        owner.code = code_.encode(position);
        owner.reference_depth = interpolation.depth(weights);
        owner.depth = owner.reference_depth;
        if (!arithmetic_.known().divide) {
            glm::vec3 bound;
            for (int k = 0; k < 3; ++k)
                bound[k] = interpolation_bound(positions[0][k], positions[1][k], positions[2][k]);
            owner.code_range = {code_.encode(position - bound), code_.encode(position + bound)};
            const double error = depth_bound(corners);
            owner.depth = {owner.reference_depth - error, owner.reference_depth + error};
        }
        owner.is_reference = covered;
        owner.sure = covered && margin > snap;
        owner.edge_margin = margin;
        add(owner, x, y);
    }

    /// z and w interpolate like positions; their quotient is halved and moved, 2.5 ULP and two roundings.
    static double depth_bound(const std::array<glm::vec4, 3>& c) {
        const double z = interpolation_bound(c[0].z, c[1].z, c[2].z);
        const double w = interpolation_bound(c[0].w, c[1].w, c[2].w);
        const double least_w = std::min({std::abs(c[0].w), std::abs(c[1].w), std::abs(c[2].w)});
        return least_w > 0.0 ? 0.5 * (z + w) / least_w + 3.0 * 0x1p-23 : 1.0;
    }

    A fp_;
    const FrameParams& params_;
    const Profile& profile_;
    CollisionCode code_;
    LegalArithmetic<A> arithmetic_;
    Wanted wanted_;
    std::vector<std::vector<TexelOwner>> candidates_;
};

/// What a depth test LESS may leave of the candidates, in drawing order: an equally deep earlier one stays.
LegalTexel settle(std::vector<TexelOwner>& candidates) {
    TexelOwner* reference = nullptr;
    for (TexelOwner& candidate : candidates) {
        const bool wins =
            candidate.is_reference && (reference == nullptr || candidate.reference_depth < reference->reference_depth);
        candidate.is_reference = false;
        if (wins)
            reference = &candidate;
    }
    if (reference != nullptr)
        reference->is_reference = true;

    LegalTexel texel;
    for (const TexelOwner& candidate : candidates) {
        const bool hidden = std::any_of(candidates.begin(), candidates.end(), [&](const TexelOwner& other) {
            if (&other == &candidate || !other.sure)
                return false;
            if (other.clip_zw && other.clip_zw == candidate.clip_zw)
                return &other < &candidate;
            return &other < &candidate ? other.depth.high <= candidate.depth.low
                                       : other.depth.high < candidate.depth.low;
        });
        if (!hidden)
            texel.owners.push_back(candidate);
    }
    if (std::none_of(candidates.begin(), candidates.end(), [](const TexelOwner& c) { return c.sure; }))
        texel.owners.push_back({.is_reference = reference == nullptr});
    return texel;
}

} // namespace

bool TexelOwner::stores(glm::vec4 texel) const {
    if (same_bits(code, texel))
        return true;
    if (!code_range)
        return false;
    const auto& [low, high] = *code_range;
    for (int c = 0; c < 4; ++c)
        if (!(low[c] <= texel[c] && texel[c] <= high[c]))
            return false;
    return true;
}

const TexelOwner* LegalTexel::owner_of(glm::vec4 texel) const {
    const TexelOwner* found = nullptr;
    for (const TexelOwner& owner : owners)
        if (owner.stores(texel) && (found == nullptr || owner.is_reference))
            found = &owner;
    return found;
}

std::vector<Tie> LegalTexel::ties(const TexelOwner& owner) const {
    std::vector<Tie> ties;
    if (owner.is_reference)
        return ties;
    const auto reference =
        std::find_if(owners.begin(), owners.end(), [](const TexelOwner& other) { return other.is_reference; });
    double edge = owner.sure ? HUGE_VAL : owner.edge_margin;
    if (reference != owners.end() && !reference->sure)
        edge = std::min(edge, reference->edge_margin);
    if (edge < HUGE_VAL)
        ties.push_back({TieKind::point_edge, edge});
    else if (reference != owners.end())
        ties.push_back({TieKind::depth, std::abs(middle(owner.depth) - middle(reference->depth))});
    return ties;
}

std::vector<LegalTexel> legal_texels(const Mesh& obstacles, const Particles& before, const Particles& after,
                                     const FrameParams& params, const Profile& profile, const KnownOperations& known,
                                     std::span<const std::size_t> texels) {
    const FlushSubnormals guard(known.subnormals && profile.flush_subnormals);
    const auto& positions =
        params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
    std::vector<std::vector<TexelOwner>> candidates = with_arithmetic(profile, params.switches, [&](auto fp) {
        Candidates all(fp, params, profile, known, texels);
        if (params.switches.obstacles_in_cdt == ObstaclesInCdt::triangles)
            all.add_triangles(obstacles);
        if (params.switches.obstacles_in_cdt == ObstaclesInCdt::vertices)
            for (std::size_t i = 0; i < obstacles.positions.size(); ++i)
                all.add_point(Kind::obstacle, i, obstacles.positions[i], obstacles.positions[i]);
        for (std::size_t i = 0; i < positions.size(); ++i)
            all.add_point(Kind::particle, i, positions[i], after.position[i]);
        return all.take();
    });
    std::vector<LegalTexel> legal;
    legal.reserve(candidates.size());
    for (std::vector<TexelOwner>& of_texel : candidates)
        legal.push_back(settle(of_texel));
    return legal;
}

} // namespace lockstep
