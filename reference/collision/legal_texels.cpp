#include "reference/collision/legal_texels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/measured_codes.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/legal_interpolation.hpp"
#include "reference/legal_triangles.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/paired_rows.hpp"
#include "reference/parallel_blocks.hpp"
#include "reference/pixel_set.hpp"
#include "reference/subnormal_mode.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// Calls visit(index) for the texels of an image that are at most `reach` away from one of `texels`, along both axes.
template <class Visit>
void for_each_near(int width, int height, std::span<const std::size_t> texels, int reach, const Visit& visit) {
    for (const std::size_t texel : texels) {
        const int x = static_cast<int>(texel) % width, y = static_cast<int>(texel) / width;
        for (int ny = std::max(y - reach, 0); ny <= std::min(y + reach, height - 1); ++ny)
            for (int nx = std::max(x - reach, 0); nx <= std::min(x + reach, width - 1); ++nx)
                visit(static_cast<std::size_t>(ny) * static_cast<std::size_t>(width) + static_cast<std::size_t>(nx));
    }
}

/// The texels asked for, by their place in the image.
class WantedTexels {
  public:
    WantedTexels(int width, int height, std::span<const std::size_t> texels)
        : texels_(width, height, texels), near_(width, height, 0) {
        for_each_near(width, height, texels, 1, [&](std::size_t near) { near_.texels[near] = 1; });
    }
    [[nodiscard]] const PixelSet& texels() const { return texels_; }
    [[nodiscard]] int slot(int x, int y) const { return texels_.place(x, y); }
    /// Whether this texel or one of the eight around it is asked for.
    [[nodiscard]] bool near(std::int32_t texel) const { return near_.texels[static_cast<std::size_t>(texel)] != 0; }

  private:
    PixelSet texels_;
    Image<std::uint8_t> near_;
};

/// Pixels of one axis that a point may cover.
struct PixelRange {
    int first = 0, last = -1;
    double edge_margin = 0.0; ///< 1/256 pixel

    [[nodiscard]] bool one_answer() const { return first == last; }
};

/// A number for what lies at these places.
std::uint64_t place_of(float x, float y) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(x)} << 32U | std::bit_cast<std::uint32_t>(y);
}

/// A point's square of side 1 covers the centres inside; which of two on its border is open, unless it is known.
PixelRange pixels_of(Interval window, const KnownRaster& known, const RasterRules& rules) {
    const double centre = interval::middle(window);
    const double margin = std::abs(centre - std::round(centre)) * 256.0;
    if (!known.point_grid) {
        const double low = window.low - grid_step(known);
        const double high = window.high + grid_step(known);
        return {static_cast<int>(std::ceil(low)) - 1, static_cast<int>(std::floor(high)), margin};
    }
    RasterRules lower = rules, upper = rules;
    if (!known.point_edges) {
        lower.point_edge_to_lower = true;
        upper.point_edge_to_lower = false;
    }
    const auto place = [&](double x, const RasterRules& edge) {
        return point_pixel(snap_point(static_cast<float>(x), rules), edge);
    };
    return {place(window.low, lower), place(window.high, upper), margin};
}

enum class InVolume { no, maybe, yes };

/// Of coordinates `first` and up: 0 for all three, 2 for the depth alone.
InVolume in_clip_volume(const std::array<Interval, 4>& clip, const ClipDepth& depth, std::size_t first = 0) {
    const Interval w = clip[3];
    if (w.any || !(w.high > 0.0) || clip[0].any || clip[1].any || clip[2].any)
        return InVolume::no;
    InVolume result = w.low > 0.0 ? InVolume::yes : InVolume::maybe;
    for (std::size_t c = first; c < 3; ++c) {
        const double least = clip[c].contains_zero() ? 0.0 : std::min(std::abs(clip[c].low), std::abs(clip[c].high));
        const double most = std::max(std::abs(clip[c].low), std::abs(clip[c].high));
        if (least > w.high)
            return InVolume::no;
        if (most > w.low)
            result = InVolume::maybe;
    }
    if (depth.from_zero() && clip[2].low < 0.0)
        return clip[2].high < 0.0 ? InVolume::no : InVolume::maybe;
    return result;
}

/// Candidates as they are found, each with the place of its texel among those that are wanted.
using Found = std::vector<std::pair<int, TexelOwner>>;

/// Collects the candidates of every wanted texel, in drawing order.
template <class A> class Candidates {
  public:
    Candidates(A fp, const FrameParams& params, const Profile& profile, const KnownOperations& known,
               std::span<const std::size_t> texels)
        : fp_(fp), params_(params), drawn_(drawn_by_rasteriser(params)), profile_(profile), converts_(known.converts),
          drops_outside_(measured_of(profile, brink_rows) == OfPair::first),
          by_driver_(!profile.follows(driver_interpolates_row)), code_(params),
          arithmetic_(fp, known, profile.other_orders),
          placing_(fp, known_in_step(params.switches, known, profile), profile.other_orders),
          corners_(fp, of_corners(known, profile), profile.other_orders), wanted_(params.width, params.height, texels),
          candidates_(texels.size()) {}

    /// `points` in order; `texels`: where the reference draws each. `add(i, found)` adds what may come of point i; any
    /// thread calls it, in the subnormal mode of this one, for those near a wanted texel or drawn nowhere.
    template <class Add>
    void add_points(std::span<const std::uint32_t> points, std::span<const std::int32_t> texels, const Add& add) {
        constexpr std::size_t block = 1024;
        const SubnormalMode mode = subnormal_mode();
        std::vector<Found> parts((points.size() + block - 1) / block);
        parallel_blocks(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t b) {
            const FlushSubnormals guard(mode.flush_operands, mode.flush_results);
            const std::size_t first = static_cast<std::size_t>(b) * block;
            for (const std::size_t i : points.subspan(first, std::min(block, points.size() - first)))
                if (texels[i] == no_texel || wanted_.near(texels[i]))
                    add(i, parts[static_cast<std::size_t>(b)]);
        });
        for (const Found& found : parts)
            take_in(found);
    }

    void add_point(TexelOwner::Kind kind, std::size_t index, glm::vec3 drawn_at, glm::vec3 stored, Found& found) const {
        const PointFragment reference = point_fragment(drawn_at, drawn_, profile_);
        const bool drawn = reference.x >= 0;
        TexelOwner owner{.kind = kind, .index = index, .code = code_.encode(stored)};
        owner.reference_depth = reference.depth;
        if (kind == TexelOwner::Kind::particle ? converts_.particles : converts_.vertices)
            owner.code_range = measured_codes(params_, stored, stored, profile_);
        const bool all_known = known().points || known().raster.points();
        if (all_known && (drawn || drops_outside_)) {
            owner.is_reference = true;
            owner.depth = reference.depth;
            if (drawn)
                add(owner, reference.x, reference.y, found);
            return;
        }
        const auto clip = arithmetic_.transform(params_.collision_proj_view, arithmetic_.read(drawn_at));
        const InVolume inside = in_clip_volume(clip, params_.clip_depth);
        const bool is_outside = inside == InVolume::no && !drops_outside_ && beside_volume(clip, owner);
        if ((inside == InVolume::no && !is_outside) || (all_known && !is_outside) || clip[3].contains_zero())
            return;
        const bool clip_known = clip[0].is_point() && clip[1].is_point() && clip[2].is_point() && clip[3].is_point();
        const bool window_known = known().raster.point_window && clip_known;
        WindowPosition window;
        if (clip_known)
            window = window_position({clip[0].as_float(), clip[1].as_float(), clip[2].as_float(), clip[3].as_float()},
                                     params_.width, params_.height, profile_.raster, params_.clip_depth);
        const double half_width = params_.width * 0.5;
        const double half_height = params_.height * 0.5;
        const auto along = [&](const Interval& coordinate, float followed, double half) {
            const Interval place = window_known
                                       ? Interval(followed)
                                       : window_coordinate(coordinate, clip[3], half, half,
                                                           window_accuracy(known().raster.point_window_accurate));
            return pixels_of(place, known().raster, profile_.raster);
        };
        const PixelRange columns = along(clip[0], window.x, half_width);
        const PixelRange rows = along(clip[1], window.y, half_height);
        owner.depth = known().raster.point_depth && drawn
                          ? Interval(reference.depth)
                          : window_coordinate(clip[2], clip[3], params_.clip_depth.scale(), params_.clip_depth.offset(),
                                              gl_window_accuracy);
        owner.place = place_of(window.x, window.y);
        if (clip[2].is_point() && clip[3].is_point() && known().raster.equal_depth)
            owner.clip_zw = glm::vec2(clip[2].as_float(), clip[3].as_float());
        owner.may_be_clipped = inside != InVolume::yes;
        add_range(owner, columns, rows, reference, found);
    }

    /// Whether a point lies beside the view volume, and by less than half a pixel, within its depths; then says how
    /// far.
    [[nodiscard]] bool beside_volume(const std::array<Interval, 4>& clip, TexelOwner& owner) const {
        if (in_clip_volume(clip, params_.clip_depth, 2) == InVolume::no || clip[3].contains_zero())
            return false;
        const auto beyond = [&](const Interval& coordinate, int size) {
            return (std::abs(interval::middle(coordinate)) / interval::middle(clip[3]) - 1.0) * 0.5 * size;
        };
        const double pixels = std::max(beyond(clip[0], params_.width), beyond(clip[1], params_.height));
        if (!(pixels < 0.5))
            return false;
        owner.outside = 256.0 * std::max(pixels, 0.0);
        return true;
    }

    /// A point whose texel and depth the pass finds by itself (placed_point of collision_pass.cpp).
    void add_placed_point(std::size_t index, glm::vec3 drawn_at, glm::vec3 stored, Found& found) const {
        const PointFragment reference = point_fragment(drawn_at, params_, profile_);
        const auto clip = placing_.transform(params_.collision_proj_view, placing_.read(drawn_at));
        if (clip[3].any || !(clip[3].low > 0.0))
            return;
        const auto doubled = [&](const Interval& coordinate, bool divides) {
            return placing_.sum(divides ? placing_.divide(coordinate, clip[3]) : coordinate, 1.0F);
        };
        const bool divides = params_.switches.perspective_divide == PerspectiveDivide::on;
        const auto along = [&](const Interval& coordinate, int size) {
            return placing_.product(placing_.product(doubled(coordinate, divides), 0.5F), static_cast<float>(size));
        };
        const Interval x = along(clip[0], params_.width), y = along(clip[1], params_.height);
        const Interval depth = params_.clip_depth.from_zero() ? placing_.divide(clip[2], clip[3])
                                                              : placing_.product(doubled(clip[2], true), 0.5F);
        if (x.any || y.any || depth.any || depth.high < 0.0 || depth.low > 1.0)
            return;
        TexelOwner owner{.kind = TexelOwner::Kind::particle, .index = index, .code = code_.encode(stored)};
        owner.reference_depth = reference.depth;
        if (converts_.particles)
            owner.code_range = measured_codes(params_, stored, stored, profile_);
        owner.depth = depth.is_point()                ? Interval(reference.depth)
                      : params_.clip_depth.reversed() ? interval::negate(depth)
                                                      : depth;
        owner.place = place_of(x.as_float(), y.as_float());
        if (clip[2].is_point() && clip[3].is_point())
            owner.clip_zw = glm::vec2(clip[2].as_float(), clip[3].as_float());
        const PixelRange columns = texels_of(x, params_.width), rows = texels_of(y, params_.height);
        owner.may_be_clipped = depth.low < 0.0 || depth.high > 1.0 || columns.first < 0 || rows.first < 0 ||
                               columns.last >= params_.width || rows.last >= params_.height;
        add_range(owner, columns, rows, reference, found);
    }

    void add_triangles(const DrawnFrame& frame, bool flush) {
        const Mesh& obstacles = frame.obstacles;
        const AssembledTriangles& assembled = frame.triangles(flush, [&] {
            std::vector<glm::vec4> clip(obstacles.positions.size());
            std::transform(obstacles.positions.begin(), obstacles.positions.end(), clip.begin(),
                           [&](glm::vec3 p) { return fp_.transform(params_.collision_proj_view, p); });
            return clip;
        });
        KnownRaster raster = known().raster;
        if (corners_open()) // a corner may be where no rounding of the reference's is
            raster.triangle_window = raster.corner_window_accurate = false;
        const LegalTriangles triangles(assembled, raster, known().points && !corners_open());
        Found found;
        triangles.for_each(wanted_.texels(), [&](const LegalCover& cover) {
            add_fragment(obstacles, assembled.clip, cover.triangle, cover.rules, cover.x, cover.y, cover.covered,
                         cover.sure, found);
        });
        take_in(found);
    }

    std::vector<std::vector<TexelOwner>> take() { return std::move(candidates_); }

  private:
    /// The texels that the listing's lines 2 to 4 may give; -1 and `size` stand for all that lie outside.
    [[nodiscard]] PixelRange texels_of(const Interval& place, int size) const {
        const auto texel = [&](double x) {
            const bool truncated = params_.switches.base_texel == BaseTexel::truncate && x > -1.0 && x < 0.0;
            return truncated ? 0 : static_cast<int>(std::floor(std::clamp(x, -1.0, static_cast<double>(size))));
        };
        const double centre = interval::middle(place);
        return {texel(place.low), texel(place.high), std::abs(centre - std::round(centre)) * 256.0};
    }

    /// To each texel of a range of which it is drawn to one.
    void add_range(TexelOwner owner, const PixelRange& columns, const PixelRange& rows, const PointFragment& reference,
                   Found& found) const {
        owner.sure = !owner.may_be_clipped && columns.one_answer() && rows.one_answer();
        owner.reach = {columns.first, rows.first, columns.last + 1, rows.last + 1};
        owner.edge_margin = HUGE_VAL;
        if (!columns.one_answer())
            owner.edge_margin = columns.edge_margin;
        if (!rows.one_answer())
            owner.edge_margin = std::min(owner.edge_margin, rows.edge_margin);
        for (int y = rows.first; y <= rows.last; ++y)
            for (int x = columns.first; x <= columns.last; ++x) {
                owner.is_reference = x == reference.x && y == reference.y;
                owner.drawn_by_reference = owner.is_reference;
                owner.shift = reference.x >= 0 ? glm::dvec2(x - reference.x, y - reference.y) : glm::dvec2(0.0);
                add(owner, x, y, found);
            }
    }

    void add(const TexelOwner& owner, int x, int y, Found& found) const {
        if (const int slot = wanted_.slot(x, y); slot >= 0)
            found.emplace_back(slot, owner);
    }

    void take_in(const Found& found) {
        for (const auto& [slot, owner] : found)
            candidates_[static_cast<std::size_t>(slot)].push_back(owner);
    }

    void add_fragment(const Mesh& obstacles, const std::vector<glm::vec4>& clip, const RasterTriangle& triangle,
                      const RasterRules& rules, int x, int y, bool covered, bool sure, Found& found) const {
        const std::uint32_t* index = &obstacles.indices[std::size_t{triangle.primitive} * 3];
        const std::array<glm::vec4, 3> corners{clip[index[0]], clip[index[1]], clip[index[2]]};
        const std::array<glm::vec3, 3> positions{obstacles.positions[index[0]], obstacles.positions[index[1]],
                                                 obstacles.positions[index[2]]};
        const TriangleInterpolation interpolation(fp_, corners, params_.width, params_.height, params_.clip_depth);
        const auto weights = interpolation.weights(x, y);
        TexelOwner owner{.kind = TexelOwner::Kind::obstacle, .index = triangle.primitive};
        const glm::vec3 position = interpolation.mix(fp_, positions, weights);
        owner.code = code_.encode(position);
        owner.reference_depth = interpolation.depth(weights);
        LegalFragment legal{{position.x, position.y, position.z}, owner.reference_depth};
        if (corners_open())
            legal = legal_fragment({legal_corner(positions[0]), legal_corner(positions[1]), legal_corner(positions[2])},
                                   positions, x, y, params_.width, params_.height, params_.clip_depth);
        owner.depth = legal.depth;
        glm::vec3 low = position, high = position;
        if (corners_open() || !known().interpolation || by_driver_) {
            DriverInterpolation driver;
            if (by_driver_)
                driver = driver_interpolation(fp_, corners, positions, x, y, params_.width, params_.height,
                                              params_.clip_depth, grid_of_corners());
            for (int k = 0; k < 3; ++k) {
                const Interval& place = legal.position[static_cast<std::size_t>(k)];
                const float bound =
                    interpolation_bound(positions[0][k], positions[1][k], positions[2][k]) + driver.position[k];
                low[k] = static_cast<float>(place.low) - bound;
                high[k] = static_cast<float>(place.high) + bound;
            }
            owner.code_range = {code_.encode(low), code_.encode(high)};
            const double error = depth_bound(corners, params_.clip_depth) + driver.depth;
            owner.depth = {legal.depth.low - error, legal.depth.high + error};
        }
        if (converts_.triangles)
            owner.code_range = measured_codes(params_, low, high, profile_);
        if (params_.switches.search == Search::depth)
            store_depth(owner);
        owner.is_reference = covered && rules == profile_.raster;
        owner.sure = sure;
        const NearestSide side = nearest_side(triangle, x, y, rules);
        owner.edge_margin = sure ? HUGE_VAL : std::ldexp(side.distance, 8 - rules.subpixel_bits);
        owner.shift = covered ? -side.outward : side.outward;
        owner.is_side = true;
        owner.drawn_by_reference = covered;
        owner.place = std::uint64_t{triangle.primitive} << 32U | static_cast<std::uint32_t>(y * params_.width + x);
        add(owner, x, y, found);
    }

    static void store_depth(TexelOwner& owner) {
        owner.code = depth_code(owner.reference_depth);
        if (owner.code_range)
            owner.code_range = {depth_code(std::nextafter(static_cast<float>(owner.depth.low), -HUGE_VALF)),
                                depth_code(std::nextafter(static_cast<float>(owner.depth.high), HUGE_VALF))};
    }

    /// Of the obstacles' vertex stage.
    static KnownOperations of_corners(KnownOperations known, const Profile& profile) {
        known.sums = known.sums && !profile.open_corners;
        return known;
    }
    [[nodiscard]] bool corners_open() const { return !corners_.known().sums; }
    [[nodiscard]] std::array<Interval, 4> legal_corner(glm::vec3 position) const {
        return corners_.transform(params_.collision_proj_view, corners_.read(position));
    }

    /// By how much the driver's grid moves a corner, pixels.
    [[nodiscard]] double grid_of_corners() const {
        return known().points || known().raster.triangle_grid ? std::ldexp(1.0, -profile_.raster.subpixel_bits)
                                                              : grid_step(known().raster);
    }

    [[nodiscard]] const KnownOperations& known() const { return arithmetic_.known(); }

    A fp_;
    const FrameParams& params_;
    FrameParams drawn_; ///< as points are drawn that the rasteriser places
    const Profile& profile_;
    DriverConverts converts_;
    bool drops_outside_; ///< points whose centre lies outside the view volume, as GL says
    bool by_driver_;     ///< obstacles' positions are interpolated
    CollisionCode code_;
    LegalArithmetic<A> arithmetic_, placing_; ///< placing_: in the stage that finds the texels of points
    LegalArithmetic<A> corners_;
    WantedTexels wanted_;
    std::vector<std::vector<TexelOwner>> candidates_;
};

/// What a depth test LESS may leave of the candidates, in drawing order: an equally deep earlier one stays, if that is
/// known.
LegalTexel settle(std::vector<TexelOwner>& candidates, bool first_stays) {
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
            return first_stays && &other < &candidate ? other.depth.high <= candidate.depth.low
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
        if (!same_bits(code[c], texel[c]) && !(low[c] <= texel[c] && texel[c] <= high[c]))
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
    if (owner.outside) {
        ties.push_back({outside_tie, *owner.outside});
        return ties;
    }
    const auto reference =
        std::find_if(owners.begin(), owners.end(), [](const TexelOwner& other) { return other.is_reference; });
    double edge = owner.sure ? HUGE_VAL : owner.edge_margin;
    if (reference != owners.end() && !reference->sure)
        edge = std::min(edge, reference->edge_margin);
    if (edge < HUGE_VAL)
        ties.push_back({point_edge_tie, edge});
    else if (reference != owners.end())
        ties.push_back({depth_tie, std::abs(interval::middle(owner.depth) - interval::middle(reference->depth))});
    return ties;
}

std::span<const glm::vec3> DrawnFrame::points() const {
    return params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
}

std::span<const std::int32_t> DrawnFrame::texels_of_points() const {
    if (texels_of_points_.size() != points().size()) {
        found_texels_ = std::make_unique_for_overwrite<std::int32_t[]>(points().size());
        const std::span found(found_texels_.get(), points().size());
        point_texels_fast(points(), params, profile, found);
        texels_of_points_ = found;
    }
    return texels_of_points_;
}

std::span<const std::uint32_t> DrawnFrame::points_near(std::span<const std::size_t> texels) const {
    bool found = near_.width != 0;
    if (found)
        for_each_near(params.width, params.height, texels, 1,
                      [&](std::size_t near) { found = found && near_.texels[near] != 0; });
    if (found)
        return near_points_;
    constexpr int reach = 3; // where a point of these texels may land as well is asked next
    near_ = Image<std::uint8_t>(params.width, params.height, 0);
    for_each_near(params.width, params.height, texels, reach, [&](std::size_t near) { near_.texels[near] = 1; });
    const std::span<const std::int32_t> drawn = texels_of_points();
    constexpr std::size_t block = 16384;
    std::vector<std::vector<std::uint32_t>> parts((drawn.size() + block - 1) / block);
    parallel_blocks(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        for (std::size_t i = first; i < std::min(first + block, drawn.size()); ++i)
            if (drawn[i] == no_texel || near_.texels[static_cast<std::size_t>(drawn[i])] != 0)
                parts[static_cast<std::size_t>(b)].push_back(static_cast<std::uint32_t>(i));
    });
    near_points_.clear();
    for (const std::vector<std::uint32_t>& part : parts)
        near_points_.insert(near_points_.end(), part.begin(), part.end());
    return near_points_;
}

std::vector<LegalTexel> legal_texels(const DrawnFrame& frame, const KnownOperations& known,
                                     std::span<const std::size_t> texels) {
    const FrameParams& params = frame.params;
    const Profile& profile = frame.profile;
    const bool flush = known.subnormals && profile.flush_subnormals;
    const FlushSubnormals guard(flush);
    const auto positions = frame.points();
    std::vector<std::vector<TexelOwner>> candidates =
        with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
            Candidates all(fp, params, profile, known, texels);
            const Mesh& obstacles = frame.obstacles;
            if (params.switches.obstacles_in_cdt == ObstaclesInCdt::triangles)
                all.add_triangles(frame, flush);
            if (params.switches.obstacles_in_cdt == ObstaclesInCdt::vertices) {
                std::vector<std::int32_t> drawn(obstacles.positions.size());
                point_texels_fast(obstacles.positions, drawn_by_rasteriser(params), profile, drawn);
                std::vector<std::uint32_t> every(drawn.size());
                std::iota(every.begin(), every.end(), 0U);
                all.add_points(every, drawn, [&](std::size_t i, Found& found) {
                    all.add_point(TexelOwner::Kind::obstacle, i, obstacles.positions[i], obstacles.positions[i], found);
                });
            }
            const auto drawn = frame.texels_of_points();
            const auto near = frame.points_near(texels);
            if (params.switches.step == Step::compute) {
                const bool subnormals = known_in_step(params.switches, known, profile).subnormals;
                const FlushSubnormals in_step = flush_in_step(params.switches, profile, subnormals);
                all.add_points(near, drawn, [&](std::size_t i, Found& found) {
                    all.add_placed_point(i, positions[i], frame.after.position[i], found);
                });
            } else {
                all.add_points(near, drawn, [&](std::size_t i, Found& found) {
                    all.add_point(TexelOwner::Kind::particle, i, positions[i], frame.after.position[i], found);
                });
            }
            return all.take();
        });
    std::vector<LegalTexel> legal;
    legal.reserve(candidates.size());
    for (std::vector<TexelOwner>& of_texel : candidates)
        legal.push_back(settle(of_texel, known.points || known.raster.equal_depth));
    return legal;
}

std::vector<LegalTexel> legal_texels(const Mesh& obstacles, const Particles& before, const Particles& after,
                                     const FrameParams& params, const Profile& profile, const KnownOperations& known,
                                     std::span<const std::size_t> texels) {
    return legal_texels(DrawnFrame(obstacles, before, after, params, profile), known, texels);
}

} // namespace lockstep
