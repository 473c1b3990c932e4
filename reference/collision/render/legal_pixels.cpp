#include "reference/collision/render/legal_pixels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "reference/collision/render/sprite.hpp"
#include "reference/collision/shading.hpp"
#include "reference/legal_number.hpp"
#include "reference/legal_triangles.hpp"
#include "reference/pixel_set.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {
namespace {

using A = PlainArithmetic;
using Legal = LegalOperations<A>;

/// In a stage whose operations nobody measured: GLSL's rules.
KnownOperations geometry_stage(const KnownOperations& known) {
    return {.sums = known.sums, .subnormals = known.subnormals};
}

KnownOperations fragment_stage(const KnownOperations& known) {
    return {.sums = known.sums && known.interpolation,
            .divide = known.divide && known.interpolation,
            .subnormals = known.subnormals};
}

/// What is known of a triangle's way to pixels whose corners `precise` does not hold.
KnownRaster known_raster(const KnownOperations& known) {
    KnownRaster raster = known.points ? KnownRaster::all() : known.raster;
    if (!known.sums)
        raster.triangle_window = raster.corner_window_accurate = false;
    return raster;
}

/// Along one axis, the pixels that a billboard may cover, and those among them that it surely does; ends excluded.
struct Span {
    int first_may = 0, first_sure = 0, end_sure = 0, end_may = 0;
    double low = 0.0, high = 0.0; ///< window, of its sides

    [[nodiscard]] bool surely(int pixel) const { return first_sure <= pixel && pixel < end_sure; }
    [[nodiscard]] double margin(int pixel) const {
        return 256.0 * std::min(std::abs(pixel + 0.5 - low), std::abs(pixel + 0.5 - high));
    }
};

struct LegalSprite {
    Vec3<LegalNumber<A>> centre; ///< view space
    BillboardWindowOf<Vec2<LegalNumber<A>>> window;
    Span columns, rows;
    bool surely_visible = false;
};

/// A triangle at a wanted pixel.
struct Cover {
    std::uint32_t triangle;
    bool sure;
    double margin;
};

/// What may be drawn to a wanted pixel, in drawing order.
struct WantedPixel {
    int x, y;
    std::vector<Cover> covers;
    std::vector<std::uint32_t> particles;
};

/// `Sites`: of the pass, or of one with a mistake.
template <class Sites> class LegalPixels {
  public:
    LegalPixels(const Sites& sites, const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                const Profile& profile, const KnownOperations& known)
        : sites_(sites), particles_(particles), obstacles_(obstacles), params_(params), profile_(profile),
          known_(known), raster_(known_raster(known)), width_(params.render_width), height_(params.render_height),
          fp_(profile), vertex_arithmetic_(fp_, known), geometry_arithmetic_(fp_, geometry_stage(known)),
          fragment_arithmetic_(fp_, fragment_stage(known)), vertex_(vertex_arithmetic_),
          geometry_(geometry_arithmetic_), fragment_(fragment_arithmetic_), shading_(fragment_, sites),
          triangles_(projected(), obstacles.indices, width_, height_, profile.raster) {}

    /// Of pixels of the image, once it is as it is stored.
    std::vector<LegalPixel> at(std::span<const std::size_t> pixels) const {
        const std::vector<WantedPixel> wanted = wanted_at(pixels);
        std::vector<LegalPixel> legal(pixels.size());
        const auto count = static_cast<std::ptrdiff_t>(pixels.size());
#pragma omp parallel for schedule(dynamic, 64)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const FlushSubnormals guard(known_.subnormals && profile_.flush_subnormals);
            for (const PixelFragment& seen : fragments_of(wanted[static_cast<std::size_t>(i)], false))
                legal[static_cast<std::size_t>(i)].candidates.push_back(seen.candidate);
        }
        return legal;
    }

    /// The same of one, with what is hidden.
    std::vector<PixelFragment> fragments_at(std::size_t pixel) const {
        return fragments_of(wanted_at(std::span(&pixel, 1)).front(), true);
    }

  private:
    [[nodiscard]] std::vector<glm::vec4> projected() const {
        std::vector<glm::vec4> clip;
        for (const glm::vec3& position : obstacles_.positions)
            clip.push_back(fp_.transform(params_.render_projection, fp_.transform(params_.render_view, position)));
        return clip;
    }

    std::vector<WantedPixel> wanted_at(std::span<const std::size_t> pixels) const {
        std::vector<WantedPixel> wanted;
        Image<std::vector<std::int32_t>> slots(width_, height_);
        std::vector<std::size_t> sources;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto columns = static_cast<std::size_t>(width_);
            const glm::ivec2 from = sites_.source(static_cast<int>(pixels[i] % columns),
                                                  static_cast<int>(pixels[i] / columns), width_, height_);
            slots.at(from.x, from.y).push_back(static_cast<std::int32_t>(i));
            sources.push_back(slots.index(from.x, from.y));
            wanted.push_back({from.x, from.y, {}, {}});
        }
        const auto each = [&](int x, int y, const auto& add) {
            for (const std::int32_t slot : slots.at(x, y))
                add(wanted[static_cast<std::size_t>(slot)]);
        };
        const LegalTriangles triangles(triangles_, raster_, known_.points && known_.sums);
        triangles.for_each(PixelSet(width_, height_, sources), [&](const LegalCover& c) {
            const double margin =
                c.sure ? HUGE_VAL
                       : std::ldexp(nearest_side(c.triangle, c.x, c.y, c.rules).distance, 8 - c.rules.subpixel_bits);
            each(c.x, c.y, [&](WantedPixel& pixel) { pixel.covers.push_back({c.triangle.primitive, c.sure, margin}); });
        });
        for (std::uint32_t i = 0; i < particles_.size(); ++i) {
            const LegalSprite seen = sprite(particles_.position[i]);
            for (int y = seen.rows.first_may; y < seen.rows.end_may; ++y)
                for (int x = seen.columns.first_may; x < seen.columns.end_may; ++x)
                    each(x, y, [&](WantedPixel& pixel) { pixel.particles.push_back(i); });
        }
        return wanted;
    }

    [[nodiscard]] Vec3<LegalNumber<A>> to_view(glm::vec3 position) const {
        const auto view = vertex_.transform(params_.render_view, vertex_.read(position));
        return {view.x, view.y, view.z};
    }

    [[nodiscard]] LegalSprite sprite(glm::vec3 position) const {
        LegalSprite result;
        result.centre = geometry_.taken(to_view(position));
        const float radius = sites_.corner_radius(params_.constants.billboard_radius);
        const glm::mat4& projection = params_.render_projection;
        const auto square = sites_.square(
            expand_billboard(geometry_, sites_.square_centre(result.centre, radius), radius, projection),
            [&] { return geometry_.transform(projection, result.centre); }, radius);
        const Truth visible = is_visible(square);
        if (!visible.yes)
            return result;
        result.surely_visible = visible.sure();
        const glm::ivec2 size = sites_.size(width_, height_, true);
        const auto window = sites_.sphere_window(billboard_window(geometry_, square, size.x, size.y));
        result.window = {fragment_.taken(window.low), fragment_.taken(window.high), fragment_.taken(window.centre),
                         fragment_.taken(window.half)};
        const auto quad = sites_.quad(square);
        const Interval w = quad.low.w.set();
        result.columns = span(quad.low.x.set(), quad.high.x.set(), w, width_, profile_.raster.left_edge_in);
        result.rows = span(quad.low.y.set(), quad.high.y.set(), w, height_, profile_.raster.lower_edge_in);
        return result;
    }

    [[nodiscard]] Span span(Interval low, Interval high, Interval w, int size, bool low_side_in) const {
        const auto window = [&](Interval clip) -> Interval {
            if (raster_.triangle_window && clip.is_point() && w.is_point()) {
                const float x = std::clamp(clip.as_float(), -w.as_float(), w.as_float());
                return window_position({x, x, 0.0F, w.as_float()}, size, size, profile_.raster.vertex_viewport).x;
            }
            const Interval place =
                window_coordinate(clip, w, size * 0.5, size * 0.5, window_accuracy(raster_.corner_window_accurate));
            const double most = size;
            return place.any ? Interval(0.0, most)
                             : Interval(std::clamp(place.low, 0.0, most), std::clamp(place.high, 0.0, most));
        };
        // The first pixel whose centre lies beyond a side, at the least and at the most.
        const auto first = [&](Interval side) {
            if (!raster_.triangle_grid) {
                const double step = grid_step(raster_);
                return std::pair(static_cast<int>(std::ceil(side.low - step - 0.5)),
                                 static_cast<int>(std::floor(side.high + step - 0.5)) + 1);
            }
            const RasterRules& rules = profile_.raster;
            const auto beyond = [&](double at, bool owned) {
                return (snap_vertex(static_cast<float>(at), rules) + (1 << rules.subpixel_bits) - (owned ? 1 : 0)) >>
                       rules.subpixel_bits;
            };
            return std::pair(beyond(side.low, !raster_.triangle_sides || low_side_in),
                             beyond(side.high, raster_.triangle_sides && low_side_in));
        };
        const Interval low_side = window(low), high_side = window(high);
        const auto [first_may, first_sure] = first(low_side);
        const auto [end_sure, end_may] = first(high_side);
        return {std::max(first_may, 0),  std::max(first_sure, 0),    std::min(end_sure, size),
                std::min(end_may, size), interval::middle(low_side), interval::middle(high_side)};
    }

    /// All that may be drawn to a pixel, in drawing order; of what is surely hidden, what hides it. `every`: hidden
    /// ones too.
    [[nodiscard]] std::vector<PixelFragment> fragments_of(const WantedPixel& wanted, bool every) const {
        struct Fragment {
            PixelCandidate candidate;
            Vec3<LegalNumber<A>> normal = {};
        };
        const float cleared = sites_.depth_test() == DepthTest::greater ? 0.0F : 1.0F;
        std::vector<Fragment> fragments{{{.depth = cleared}}};
        for (const Cover& cover : wanted.covers)
            fragments.push_back({{.owner = {PixelOwner::Kind::obstacle, cover.triangle},
                                  .depth = triangle_depth(cover.triangle, wanted.x, wanted.y),
                                  .sure = cover.sure,
                                  .edge_margin = cover.margin}});
        for (const std::uint32_t i : wanted.particles) {
            const LegalSprite seen = sprite(particles_.position[i]);
            const auto at = sphere_fragment(fragment_, sites_, fragment_.taken(seen.centre), seen.window, wanted.x,
                                            wanted.y, params_);
            if (!at.inside.yes)
                continue;
            const bool covers = seen.columns.surely(wanted.x) && seen.rows.surely(wanted.y);
            PixelCandidate candidate{
                .owner = {PixelOwner::Kind::particle, i}, .open = at.depth.open(), .depth = at.depth.set()};
            candidate.sure = seen.surely_visible && covers && at.inside.sure();
            if (!covers)
                candidate.edge_margin = std::min(seen.columns.margin(wanted.x), seen.rows.margin(wanted.y));
            if (!at.inside.sure())
                candidate.edge_margin = std::min(candidate.edge_margin, rim_margin(seen, wanted));
            fragments.push_back({candidate, at.normal});
        }
        std::vector<PixelFragment> told;
        for (Fragment& fragment : fragments) {
            const Fragment* hider = nullptr;
            for (const Fragment& other : fragments)
                if (&other != &fragment && other.candidate.sure &&
                    hides(other.candidate, fragment.candidate, &other < &fragment) &&
                    (hider == nullptr || hides(other.candidate, hider->candidate, &other < hider)))
                    hider = &other;
            if (hider != nullptr && !every)
                continue;
            color(fragment.candidate, fragment.normal, wanted.y);
            told.push_back(
                {fragment.candidate, hider != nullptr ? std::optional(hider->candidate.owner) : std::nullopt});
        }
        return told;
    }

    [[nodiscard]] double rim_margin(const LegalSprite& sprite, const WantedPixel& pixel) const {
        const double half_x = interval::middle(sprite.window.half.x.set()),
                     half_y = interval::middle(sprite.window.half.y.set());
        const double x = (pixel.x + 0.5 - interval::middle(sprite.window.centre.x.set())) / half_x;
        const double y = (pixel.y + 0.5 - interval::middle(sprite.window.centre.y.set())) / half_y;
        return 256.0 * std::abs(1.0 - std::hypot(x, y)) * std::min(half_x, half_y);
    }

    /// Whether the depth test surely lets `other` hide `candidate`.
    [[nodiscard]] bool hides(const PixelCandidate& other, const PixelCandidate& candidate, bool is_earlier) const {
        const Interval a = other.depth, b = candidate.depth;
        const bool known = known_.points || raster_.equal_depth;
        switch (sites_.depth_test()) {
        case DepthTest::less:
            return a.high < b.low || (known && is_earlier && a.high <= b.low);
        case DepthTest::less_or_equal:
            return a.high < b.low || (known && !is_earlier && a.high <= b.low);
        case DepthTest::greater:
            return a.low > b.high || (known && is_earlier && a.low >= b.high);
        case DepthTest::always:
            return !is_earlier;
        }
        return false;
    }

    [[nodiscard]] Interval triangle_depth(std::uint32_t triangle, int x, int y) const {
        const std::uint32_t* index = &obstacles_.indices[std::size_t{triangle} * 3];
        const std::array<glm::vec4, 3> corners{triangles_.clip[index[0]], triangles_.clip[index[1]],
                                               triangles_.clip[index[2]]};
        const TriangleInterpolation interpolation(fp_, corners, width_, height_);
        const double depth = interpolation.depth(interpolation.weights(x, y));
        // Where sums are free too, corners and interpolation may each err as much again.
        const double error = known_.interpolation ? 0.0 : depth_bound(corners) * (known_.sums ? 1.0 : 4.0);
        return {std::max(depth - error, 0.0), std::min(depth + error, 1.0)};
    }

    void color(PixelCandidate& candidate, const Vec3<LegalNumber<A>>& normal, int y) const {
        Vec3<LegalNumber<A>> shade;
        if (candidate.owner.kind == PixelOwner::Kind::background) {
            if (!sites_.draws_background()) {
                candidate.low = candidate.high = {};
                return;
            }
            shade = shading_.background(y, sites_.size(width_, height_, false).y);
        } else if (candidate.owner.kind == PixelOwner::Kind::obstacle) {
            const std::uint32_t* index = &obstacles_.indices[std::size_t{candidate.owner.index} * 3];
            const auto corner = [&](std::size_t k) {
                const glm::vec3 position = obstacles_.positions[index[k]];
                return sites_.shaded_corner(fragment_.taken(to_view(position)),
                                            fragment_.taken(vertex_.read(position)));
            };
            shade = shading_.obstacle({corner(0), corner(1), corner(2)});
        } else {
            const std::size_t i = candidate.owner.index;
            shade = shading_.particle(normal, fragment_.read(particles_.speed[i]),
                                      fragment_.read(particles_.collide_time[i]), params_.constants.collision_time);
        }
        const auto code = [&](LegalNumber<A> channel) {
            const LegalNumber<A> number = shading_.code_of(channel);
            candidate.open = candidate.open || number.open();
            const auto at = [](double x) { return static_cast<std::uint8_t>(std::clamp(std::floor(x), 0.0, 255.0)); };
            return std::pair(at(number.set().low), at(number.set().high));
        };
        const auto [r0, r1] = code(shade.x);
        const auto [g0, g1] = code(shade.y);
        const auto [b0, b1] = code(shade.z);
        const bool of_particle = candidate.owner.kind == PixelOwner::Kind::particle;
        candidate.low = sites_.stored({r0, g0, b0, 255}, of_particle);
        candidate.high = sites_.stored({r1, g1, b1, 255}, of_particle);
    }

    Sites sites_;
    const Particles& particles_;
    const Mesh& obstacles_;
    const FrameParams& params_;
    const Profile& profile_;
    KnownOperations known_;
    KnownRaster raster_;
    int width_, height_;
    A fp_;
    LegalArithmetic<A> vertex_arithmetic_, geometry_arithmetic_, fragment_arithmetic_;
    Legal vertex_, geometry_, fragment_; ///< of each stage
    Shading<Legal, Sites> shading_;
    AssembledTriangles triangles_;
};

template <class Sites> std::vector<LegalPixel> legal_of(const Sites& sites, const Particles& particles,
                                                        const Mesh& obstacles, const FrameParams& params,
                                                        const Profile& profile, const KnownOperations& known,
                                                        std::span<const std::size_t> pixels) {
    const FlushSubnormals guard(known.subnormals && profile.flush_subnormals);
    return LegalPixels<Sites>(sites, particles, obstacles, params, profile, known).at(pixels);
}

/// What nothing is left to a driver of.
std::vector<LegalPixel> exact_pixels(const RenderInputs& inputs, const Profile& profile,
                                     std::span<const std::size_t> pixels, std::optional<RenderMistake> mistake) {
    const RenderedFrame frame = mistake
                                    ? RenderedFrame{mistaken_render_pass(inputs, profile, *mistake), {}}
                                    : render_with_owners(inputs.particles, inputs.obstacles, inputs.params, profile);
    std::vector<LegalPixel> legal;
    for (const std::size_t i : pixels) {
        const Rgba8 color = frame.color.texels[i];
        legal.push_back({{{.owner = mistake ? PixelOwner() : frame.owner.texels[i], .low = color, .high = color}}});
    }
    return legal;
}

} // namespace

bool PixelCandidate::may_be(Rgba8 c) const {
    return low.r <= c.r && c.r <= high.r && low.g <= c.g && c.g <= high.g && low.b <= c.b && c.b <= high.b &&
           low.a <= c.a && c.a <= high.a;
}

std::vector<LegalPixel> legal_pixels(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                                     std::span<const std::size_t> pixels, std::optional<RenderMistake> mistake) {
    if (inputs.params.switches.arithmetic == ArithmeticSwitch::exact)
        return exact_pixels(inputs, profile, pixels, mistake);
    if (!mistake)
        return legal_of(RightSites(), inputs.particles, inputs.obstacles, inputs.params, profile, known, pixels);
    const MistakenInputs mistaken(inputs, *mistake);
    return legal_of(MistakenSites(*mistake), mistaken.particles(), mistaken.obstacles(), mistaken.params(), profile,
                    known, pixels);
}

std::vector<PixelFragment> pixel_fragments(const RenderInputs& inputs, const Profile& profile,
                                           const KnownOperations& known, std::size_t pixel) {
    if (inputs.params.switches.arithmetic == ArithmeticSwitch::exact) {
        PixelCandidate seen = exact_pixels(inputs, profile, std::span(&pixel, 1), {}).front().candidates.front();
        seen.depth = std::numeric_limits<float>::quiet_NaN();
        return {{seen, {}}};
    }
    const FlushSubnormals guard(known.subnormals && profile.flush_subnormals);
    return LegalPixels<RightSites>({}, inputs.particles, inputs.obstacles, inputs.params, profile, known)
        .fragments_at(pixel);
}

} // namespace lockstep
