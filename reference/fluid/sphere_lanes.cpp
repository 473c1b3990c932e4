#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

#include "reference/fluid/sphere_depth_twin.hpp"
#include "reference/fluid/thickness_twin.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

/// Each operation as the plain arithmetic of a driver has it, with tables of roots or without, lane by lane.
struct OwnOrderLanes {
    using Three = Vec3<FloatLanes>;
    OwnOrders fp;

    LOCKSTEP_INLINE static FloatLanes flush(const FloatLanes& v) { return v; }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes divide(const FloatLanes& a, const FloatLanes& b) const {
        FloatLanes made = a;
        for (int k = 0; k < lane_count; ++k)
            made[k] = fp.divide(a[k], b[k]);
        return made;
    }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes sqrt(const FloatLanes& a) const {
        return lanes::each(a, [this](float x) { return fp.sqrt(x); });
    }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes dot(const Three& a, const Three& b) const {
        FloatLanes made = a.x;
        for (int k = 0; k < lane_count; ++k)
            made[k] = fp.dot({a.x[k], a.y[k], a.z[k]}, {b.x[k], b.y[k], b.z[k]});
        return made;
    }
};

PortableLanes lanes_of(const Portable&) { return {}; }
OwnOrderLanes lanes_of(const PlainArithmetic& fp) { return {fp}; }

/// BoxesByTile::draw, a row of a tile at a time: `draw(row, drawn, place, first, last)` for pixels first to last of it,
/// the last excluded, `place` being its first pixel; `done(row, place, count)` with as many as lie in the image.
template <class Row, class Make, class Draw, class Done>
void draw_rows(const BoxesByTile& boxes, int width, int height, std::size_t tiles, const Row& empty, const Make& make,
               const Draw& draw, const Done& done) {
    constexpr int side = BoxesByTile::side;
    static_assert(side == lane_count);
    const int y0 = static_cast<int>(tiles) * side, y1 = std::min(y0 + side, height);
    for (int x0 = 0; x0 < width; x0 += side) {
        const int x1 = std::min(x0 + side, width);
        std::array<Row, side> rows;
        rows.fill(empty);
        for (const std::uint32_t i : boxes.near({x0, y0})) {
            const PixelRect& box = boxes.box(i);
            if (const auto drawn = make(i))
                for (int y = std::max(y0, box.y0); y < std::min(y1, box.y1); ++y)
                    draw(rows[static_cast<std::size_t>(y - y0)], *drawn, Pixel{x0, y}, std::max(0, box.x0 - x0),
                         std::min(x1, box.x1) - x0);
        }
        for (int y = y0; y < y1; ++y)
            done(rows[static_cast<std::size_t>(y - y0)], Pixel{x0, y}, x1 - x0);
    }
}

/// Calls `draw(row, reading, sprite, ball, place, items, inside)` for each sphere at each row of a tile that its box
/// touches, by number, and stores what `words_of(row, items)` makes of the row.
template <class Twin, class A, class Row, class Draw, class Words>
void draw_spheres(const Twin& twin, const A& fp, const PassInput& in, std::size_t tiles, const Row& empty,
                  const Draw& draw, const Words& words_of, const WritableView& after) {
    const auto lane_fp = lanes_of(fp);
    using R = Lanes<std::remove_cvref_t<decltype(lane_fp)>>;
    Values<A> one(fp);
    R reading(lane_fp, (1U << lane_count) - 1);
    const SpriteTwin<Values<A>> scalar(one, *twin.host, in.before, twin.spheres());
    const SpriteTwin<R> sprite(reading, *twin.host, in.before, twin.spheres());
    const int width = twin.host->settings().width;
    const auto items_at = [&](const Pixel& place) {
        const int first = place.y * width + place.x, last = place.y * width + width - 1;
        const IntLanes behind = from(first);
        return LaneItems{behind > last ? lanes::all(last) : behind, lane_count};
    };
    draw_rows(
        twin.boxes, width, twin.host->settings().height, tiles, empty,
        [&](std::uint32_t i) {
            const auto number = [](const auto& x) { return typename R::Real(static_cast<float>(x)); };
            std::optional<Ball<R>> wide;
            if (const auto ball = scalar.ball(i))
                wide = Ball<R>{{number(ball->centre.x), number(ball->centre.y), number(ball->centre.z)},
                               number(ball->w),
                               number(ball->x),
                               number(ball->y),
                               number(ball->half)};
            return wide;
        },
        [&](Row& row, const Ball<R>& ball, const Pixel& place, int first, int last) {
            const IntLanes lane = from(0);
            const LanePixel pixel{LaneInt(from(place.x)), place.x, place.y};
            draw(row, reading, sprite, ball, pixel, items_at(place), LaneMask((lane >= first) & (lane < last)));
        },
        [&](const Row& row, const Pixel& place, int count) {
            const IntLanes words = words_of(row, items_at(place));
            std::memcpy(after.columns[0] + (static_cast<std::size_t>(place.y) * static_cast<std::size_t>(width) +
                                            static_cast<std::size_t>(place.x)) *
                                               sizeof(float),
                        &words, static_cast<std::size_t>(count) * sizeof(float));
        });
}

template <class A> void depth_row(const SphereDepthTwin& twin, const A& fp, const PassInput& in, std::size_t tiles,
                                  const WritableView& after) {
    struct Row {
        FloatLanes key, stored;
    };
    Values<A> one(fp);
    const float nothing = DepthCode<Values<A>>(one, *twin.host).empty();
    draw_spheres(
        twin, fp, in, tiles, Row{lanes::all(1.0F), lanes::all(nothing)},
        [&](Row& row, auto& r, const auto& sprite, const auto& ball, const LanePixel& pixel, const LaneItems& items,
            const LaneMask& inside) {
            twin.offer(r, in.before, sprite, ball, pixel, items,
                       [&](const LaneMask& condition, const auto& key, const auto& stored) {
                           const IntLanes nearer = (inside && condition).v & (key.v < row.key);
                           row.key = nearer ? key.v : row.key;
                           row.stored = nearer ? stored.v : row.stored;
                       });
        },
        [](const Row& row, const LaneItems&) { return lanes::bits(row.stored); }, after);
}

template <class A> void thickness_row(const ThicknessTwin& twin, const A& fp, const PassInput& in, std::size_t tiles,
                                      const WritableView& after) {
    struct Row {
        FloatLanes sum;
        IntLanes units;
    };
    using F = decltype(lanes_of(fp));
    draw_spheres(
        twin, fp, in, tiles, Row{lanes::all(0.0F), lanes::all(0)},
        [&](Row& row, auto& r, const auto& sprite, const auto& ball, const LanePixel& pixel, const LaneItems& items,
            const LaneMask& inside) {
            twin.addend(r, in.before, sprite, ball, pixel, items, [&](const LaneMask& covered, const auto& t) {
                const IntLanes adds = (inside && covered).v;
                if (twin.is_fixed())
                    row.units += adds & __builtin_convertvector(t.v, IntLanes);
                else
                    row.sum = adds ? F::flush(row.sum + t.v) : row.sum;
            });
        },
        [&](const Row& row, const LaneItems& items) {
            return twin.is_fixed() ? lanes::bits(lane_floats(in.before, field::thickness, items, 0)) + row.units
                                   : lanes::bits(row.sum);
        },
        after);
}

} // namespace

LOCKSTEP_VECTOR_CLONES void draw_row(const SphereDepthTwin& twin, const Portable& fp, const PassInput& in,
                                     std::size_t row, const WritableView& after) {
    depth_row(twin, fp, in, row, after);
}
LOCKSTEP_VECTOR_CLONES void draw_row(const SphereDepthTwin& twin, const PlainArithmetic& fp, const PassInput& in,
                                     std::size_t row, const WritableView& after) {
    depth_row(twin, fp, in, row, after);
}
LOCKSTEP_VECTOR_CLONES void draw_row(const ThicknessTwin& twin, const Portable& fp, const PassInput& in,
                                     std::size_t row, const WritableView& after) {
    thickness_row(twin, fp, in, row, after);
}
LOCKSTEP_VECTOR_CLONES void draw_row(const ThicknessTwin& twin, const PlainArithmetic& fp, const PassInput& in,
                                     std::size_t row, const WritableView& after) {
    thickness_row(twin, fp, in, row, after);
}

} // namespace lockstep::fluid
