#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "reference/aligned_filter.hpp"
#include "reference/lights/contribution.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lights {

/// (C, count) and (D, W) of a texel, or of what is between texels.
template <class R> using Sample = std::array<typename R::Real, 8>;

/// What is read of both textures at a place in the grid, in voxels. Twin of shaders/lights/sampling.glsl.
template <class R> class SamplingTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    SamplingTwin(R& r, const Host& host, const SystemView& state) : r_(r), host_(host), state_(state) {}

    /// The mean over S^3 points in a voxel around `u`.
    [[nodiscard]] Sample<R> mean_at(const Vec3& u) const {
        const int count = samples(host_.switches().supersample);
        if (count == 1)
            return at(u);
        Sample<R> sum{};
        for (int k = 0; k < count * count * count; ++k) {
            const auto offset = [&](int i) {
                return r_.uniform(site::sample_offset,
                                  (static_cast<float>(i) + 0.5F) / static_cast<float>(count) - 0.5F);
            };
            const Vec3 place{u.x + offset(k % count), u.y + offset(k / count % count),
                             u.z + offset(k / (count * count))};
            const Sample<R> one = at(r_.note(site::sample_place, place));
            for (std::size_t c = 0; c < sum.size(); ++c)
                sum[c] = k == 0 ? one[c] : sum[c] + one[c];
        }
        const Real share = r_.uniform(site::sample_mean, 1.0F / static_cast<float>(count * count * count));
        for (Real& value : sum)
            value = value * share;
        return sum;
    }

    [[nodiscard]] Sample<R> at(const Vec3& u) const {
        const Interpolation how = host_.switches().interpolation;
        switch (r_.setting(site::interpolates, true) ? how : Interpolation::nearest) {
        case Interpolation::nearest: {
            const Vec3 place = r_.note(site::nearest_place, u);
            return texel(whole(r_.floor(place.x)), whole(r_.floor(place.y)), whole(r_.floor(place.z)));
        }
        case Interpolation::trilinear_hw:
            return filtered(u);
        case Interpolation::tricubic:
            return cubic(u);
        default:
            return linear(u);
        }
    }

  private:
    /// The texel before a place, and how far the place is behind its point.
    struct Axis {
        int base;
        Real f;
    };

    [[nodiscard]] int whole(const Real& x) const {
        return static_cast<int>(r_.to_int(site::base, r_.note(site::base, x)));
    }
    [[nodiscard]] Axis axis(const Real& u, const Site& half = site::half_texel) const {
        const Real t = r_.note(site::texel_place, u - r_.uniform(half, 0.5F));
        const int base = whole(r_.floor(t));
        Real f = r_.note(site::fraction, t - r_.real(base));
        if (host_.switches().interpolation == Interpolation::trilinear8)
            f = r_.note(site::fraction8, r_.floor(Real(256.0F) * f + Real(0.5F)) * Real(1.0F / 256.0F));
        return {base, f};
    }

    [[nodiscard]] Sample<R> texel(int x, int y, int z) const {
        const glm::ivec3 size = host_.grid().size;
        const Voxel v = clamped_cell(host_.grid(), {x, y, z});
        const bool inside = x >= 0 && y >= 0 && z >= 0 && x < size.x && y < size.y && z < size.z;
        Sample<R> found{};
        if (host_.switches().outside == Outside::black && !r_.decide(site::in_grid, inside))
            return found;
        const std::size_t i = v.index(host_.grid());
        const bool own_colour = r_.setting(site::own_colour, true),
                   own_direction = r_.setting(site::own_direction, true);
        const glm::vec4 colour = state_.vec4(own_colour ? field::voxel_colour : field::voxel_direction, i),
                        direction = state_.vec4(own_direction ? field::voxel_direction : field::voxel_colour, i);
        for (int c = 0; c < 4; ++c) {
            found[static_cast<std::size_t>(c)] = r_.read(site::texel, colour[c]);
            found[static_cast<std::size_t>(c) + 4] = r_.read(site::texel, direction[c]);
        }
        return found;
    }

    static Sample<R> lerp(const Sample<R>& a, const Sample<R>& b, const Real& f) {
        const Real rest = Real(1.0F) - f;
        Sample<R> made;
        for (std::size_t c = 0; c < made.size(); ++c)
            made[c] = a[c] * rest + b[c] * f;
        return made;
    }
    [[nodiscard]] Sample<R> linear(const Vec3& u) const {
        const Axis x = axis(u.x), y = axis(u.y), z = axis(u.z);
        const Vec3 f = r_.note(site::fractions, Vec3{x.f, y.f, z.f});
        const auto along_x = [&](int dy, int dz) {
            return lerp(texel(x.base, y.base + dy, z.base + dz), texel(x.base + 1, y.base + dy, z.base + dz), f.x);
        };
        const auto along_y = [&](int dz) { return lerp(along_x(0, dz), along_x(1, dz), f.y); };
        return lerp(along_y(0), along_y(1), f.z);
    }

    [[nodiscard]] std::array<Real, 4> weights(const Real& of) const {
        const Real f = r_.note(site::weighed, of), half(0.5F), one(1.0F), ff = f * f;
        const typename R::Vec4 all{r_.note(site::weight_before, f * (Real(-0.5F) + f * (one - f * half))),
                                   one + ff * (Real(-2.5F) + Real(1.5F) * f),
                                   f * (half + f * (Real(2.0F) - Real(1.5F) * f)), ff * (Real(-0.5F) + half * f)};
        const typename R::Vec4 w = r_.note(site::weights, all);
        return {w.x, w.y, w.z, w.w};
    }
    [[nodiscard]] int first_of_four(const Axis& along) const {
        return static_cast<int>(r_.note(site::first_texel, typename R::Int(along.base - 1)));
    }
    [[nodiscard]] Sample<R> cubic(const Vec3& u) const {
        const Site& half = site::half_texel_of_four;
        const Axis x = axis(u.x, half), y = axis(u.y, half), z = axis(u.z, half);
        const std::array<Real, 4> wx = weights(x.f), wy = weights(y.f), wz = weights(z.f);
        const int first_x = first_of_four(x), first_y = first_of_four(y), first_z = first_of_four(z);
        const auto add = [](Sample<R>& sum, const Sample<R>& one, const Real& w, bool first) {
            for (std::size_t c = 0; c < sum.size(); ++c)
                sum[c] = first ? one[c] * w : sum[c] + one[c] * w;
        };
        Sample<R> sum{};
        for (int k = 0; k < 4; ++k) {
            Sample<R> plane{};
            for (int j = 0; j < 4; ++j) {
                Sample<R> row{};
                for (int i = 0; i < 4; ++i)
                    add(row, texel(first_x + i, first_y + j, first_z + k), wx[static_cast<std::size_t>(i)], i == 0);
                add(plane, row, wy[static_cast<std::size_t>(j)], j == 0);
            }
            add(sum, plane, wz[static_cast<std::size_t>(k)], k == 0);
        }
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] = r_.setting(site::not_below, true) ? r_.max(Real(0.0F), sum[c]) : sum[c];
        return sum;
    }

    static constexpr auto fused = [](float a, float b, float f) { return std::fma(f, b - a, a); };
    static constexpr auto lerped = [](float a, float b, float f) { return a + f * (b - a); };
    static constexpr auto weighted = [](float a, float b, float f) { return a * (1.0F - f) + b * f; };

    /// Texels x, y, z of a cell at x + 2 y + 4 z.
    struct Cell {
        std::array<std::size_t, 8> index;
        std::array<bool, 8> is_black;
    };
    [[nodiscard]] static std::array<int, 3> base_of(const std::array<float, 3>& t) {
        const auto at = [](float along) {
            return std::isnan(along) ? 0 : static_cast<int>(std::floor(std::clamp(along, -0x1p30F, 0x1p30F)));
        };
        return {at(t[0]), at(t[1]), at(t[2])};
    }
    [[nodiscard]] Cell cell_at(const std::array<int, 3>& base) const {
        const glm::ivec3 size = host_.grid().size;
        Cell cell{};
        for (std::size_t k = 0; k < cell.index.size(); ++k) {
            const glm::ivec3 at(base[0] + static_cast<int>(k & 1U), base[1] + static_cast<int>(k >> 1U & 1U),
                                base[2] + static_cast<int>(k >> 2U));
            const bool inside = at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size.x && at.y < size.y && at.z < size.z;
            cell.is_black[k] = !inside && host_.switches().outside == Outside::black;
            cell.index[k] = clamped_cell(host_.grid(), {at.x, at.y, at.z}).index(host_.grid());
        }
        return cell;
    }
    [[nodiscard]] float raw(const Cell& cell, std::size_t k, std::size_t c) const {
        if (cell.is_black[k])
            return 0.0F;
        return c < 4 ? state_.real(field::voxel_colour, cell.index[k], static_cast<int>(c))
                     : state_.real(field::voxel_direction, cell.index[k], static_cast<int>(c) - 4);
    }
    template <class Mix>
    [[nodiscard]] float joined(const Cell& cell, const std::array<float, 3>& f, std::size_t c, const Mix& mixed) const {
        const auto along_x = [&](std::size_t first) {
            return mixed(raw(cell, first, c), raw(cell, first + 1, c), f[0]);
        };
        const auto along_y = [&](std::size_t first) { return mixed(along_x(first), along_x(first + 2), f[1]); };
        return mixed(along_y(0), along_y(4), f[2]);
    }

    /// The texture unit's own, as far as the driver is followed: fma(f, b - a, a) along x, y, z with f of full
    /// precision, and what lies between this and the other forms of such weights; or aligned_filter.hpp. Else what GL
    /// allows.
    [[nodiscard]] Sample<R> filtered(const Vec3& u) const {
        const std::array<Interval, 3> place{item_twin::set_of(u.x), item_twin::set_of(u.y), item_twin::set_of(u.z)};
        std::array<float, 3> t{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            t[axis] = place[axis].as_float() - 0.5F;
        const bool is_point =
            std::all_of(place.begin(), place.end(), [](const Interval& along) { return along.is_point(); });
        const bool is_aligned = host_.driver() == Driver::aligned_filter;
        const AlignedPlaces aligned = is_aligned ? aligned_places(place) : AlignedPlaces{};
        const Cell cell = is_aligned ? Cell{} : cell_at(base_of(t));
        const auto fraction = [&](std::size_t axis) { return t[axis] - std::floor(t[axis]); };
        const std::array<float, 3> f{fraction(0), fraction(1), fraction(2)};
        Sample<R> found{};
        for (std::size_t c = 0; c < found.size(); ++c) {
            const float value = is_aligned ? aligned_sum_at(place, c) : joined(cell, f, c, fused);
            std::pair<float, float> legal{value, value};
            if constexpr (requires { found[c].legal(); })
                legal = !aligned.empty()                     ? aligned_sums(aligned, c)
                        : is_point && host_.follows_driver() ? forms(cell, f, c)
                                                             : eight_bits(place, c);
            found[c] = r_.note(site::filtered, r_.unspecified(site::filtered, Real(value), legal.first, legal.second));
        }
        return found;
    }
    [[nodiscard]] std::pair<float, float> forms(const Cell& cell, const std::array<float, 3>& f, std::size_t c) const {
        return std::minmax({joined(cell, f, c, fused), joined(cell, f, c, lerped), joined(cell, f, c, weighted)});
    }

    /// A cell of texels, and what its texels weigh.
    struct AlignedPlace {
        std::array<int, 3> base;
        std::array<int, 8> weights;
    };
    using AlignedPlaces = std::vector<AlignedPlace>;
    /// In 256ths of a texel. Beyond the last texels nothing mixes, but with what is black.
    [[nodiscard]] double aligned_at(double t, std::size_t axis) const {
        const double place = filter_place(t), last = 256.0 * (host_.grid().size[static_cast<int>(axis)] - 1);
        return host_.switches().outside == Outside::black ? place : std::clamp(place, 0.0, last);
    }
    [[nodiscard]] static AlignedPlace aligned_place(const std::array<double, 3>& at) {
        AlignedPlace made{};
        std::array<int, 3> behind{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            made.base[axis] = static_cast<int>(std::floor(at[axis] / 256.0));
            behind[axis] = static_cast<int>(at[axis] - 256.0 * made.base[axis]);
        }
        made.weights = filter_weights(behind);
        return made;
    }
    /// All that a place may be rounded to; none where these are many.
    [[nodiscard]] AlignedPlaces aligned_places(const std::array<Interval, 3>& place) const {
        constexpr double most = 216.0;
        std::array<double, 3> low{}, high{};
        double count = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = aligned_at(place[axis].low - 0.5, axis);
            high[axis] = aligned_at(place[axis].high - 0.5, axis);
            count *= high[axis] - low[axis] + 1.0;
        }
        AlignedPlaces all;
        if (!(count <= most)) // or no number
            return all;
        for (double z = low[2]; z <= high[2]; z += 1.0)
            for (double y = low[1]; y <= high[1]; y += 1.0)
                for (double x = low[0]; x <= high[0]; x += 1.0)
                    all.push_back(aligned_place({x, y, z}));
        return all;
    }
    [[nodiscard]] std::pair<float, float> aligned_sums(const AlignedPlaces& places, std::size_t c) const {
        const FilterBits bits =
            host_.switches().volume_format == Format::rgba16f ? half_filter_bits : float_filter_bits;
        float low = HUGE_VALF, high = -HUGE_VALF;
        for (const AlignedPlace& at : places) {
            const Cell texels = cell_at(at.base);
            FilterCell cell{};
            for (std::size_t k = 0; k < cell.size(); ++k)
                cell[k] = raw(texels, k, c);
            if (!std::all_of(cell.begin(), cell.end(), [](float texel) { return std::isfinite(texel); }))
                return {-HUGE_VALF, HUGE_VALF}; // what weighs nothing may make it no number (D3D 11.3, 7.18.16.2)
            const auto [least, most] = aligned_sum(cell, at.weights, bits);
            low = std::min(low, least);
            high = std::max(high, most);
        }
        return {low, high};
    }
    /// Of texels or at places that are no numbers, no number.
    [[nodiscard]] float aligned_sum_at(const std::array<Interval, 3>& place, std::size_t c) const {
        std::array<double, 3> at{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            at[axis] = aligned_at(double{place[axis].as_float()} - 0.5, axis);
            if (!(std::abs(at[axis]) < 0x1p30))
                return std::numeric_limits<float>::quiet_NaN();
        }
        const float low = aligned_sums({aligned_place(at)}, c).first;
        return std::isfinite(low) ? low : std::numeric_limits<float>::quiet_NaN();
    }

    /// What any texture unit may give whose places and weights have 8 fraction bits: places right to 1 part in 10^5 (GL
    /// 4.5, 2.3.4.1) and then to 0.6 of a 256th (D3D 11.3, 3.2.4.1); weights of texels in 256ths, each of the six
    /// halvings of a cell rounded; nothing beyond the cell's least and greatest texel (7.18.16.3); results as right as
    /// the format, and to 1 part in 10^5 of the greatest texel.
    [[nodiscard]] std::pair<float, float> eight_bits(const std::array<Interval, 3>& place, std::size_t c) const {
        std::array<std::array<double, 5>, 3> tried{};
        std::array<std::size_t, 3> tries{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double free = 0.6 / 256.0 + 1e-5 * (std::abs(place[axis].low) + 0.5);
            const double low = place[axis].low - 0.5 - free, high = place[axis].high - 0.5 + free;
            tried[axis][tries[axis]++] = low;
            tried[axis][tries[axis]++] = high;
            for (double whole_at = std::ceil(low); whole_at <= high && tries[axis] < 5; whole_at += 1.0)
                tried[axis][tries[axis]++] = whole_at;
        }
        double low = HUGE_VAL, high = -HUGE_VAL;
        Texels seen;
        for (std::size_t i = 0; i < tries[0]; ++i)
            for (std::size_t j = 0; j < tries[1]; ++j)
                for (std::size_t k = 0; k < tries[2]; ++k) {
                    const double one = exact({tried[0][i], tried[1][j], tried[2][k]}, c, seen);
                    low = std::min(low, one);
                    high = std::max(high, one);
                }
        if (!seen.are_finite)
            return {-HUGE_VALF, HUGE_VALF};
        const double halvings = 6.0 / 512.0 * (seen.greatest - seen.least);
        const double largest = std::max(std::abs(seen.least), std::abs(seen.greatest));
        const double error = (host_.switches().volume_format == Format::rgba16f ? 0x1p-10 : 1e-5) * largest;
        return {static_cast<float>(std::max(low - halvings, seen.least) - error),
                static_cast<float>(std::min(high + halvings, seen.greatest) + error)};
    }
    struct Texels {
        double least = HUGE_VAL, greatest = -HUGE_VAL;
        bool are_finite = true;
    };
    [[nodiscard]] double exact(const std::array<double, 3>& t, std::size_t c, Texels& seen) const {
        std::array<int, 3> b{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            b[axis] = static_cast<int>(std::floor(t[axis]));
        const Cell cell = cell_at(b);
        double sum = 0.0;
        for (std::size_t k = 0; k < 8; ++k) {
            double weight = 1.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double f = t[axis] - b[axis];
                weight *= (k >> axis & 1U) != 0 ? f : 1.0 - f;
            }
            const auto value = double{raw(cell, k, c)};
            seen.are_finite = seen.are_finite && std::isfinite(value);
            seen.least = std::min(seen.least, value);
            seen.greatest = std::max(seen.greatest, value);
            sum += weight * value;
        }
        return sum;
    }

    R& r_;
    const Host& host_;
    const SystemView& state_;
};

} // namespace lockstep::lights
