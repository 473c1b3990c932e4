#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

#include "reference/fluid/sphere_depth_twin.hpp"
#include "reference/fluid/thickness_twin.hpp"
#include "reference/system/tile_rows.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

/// Calls `draw(row, reading, sprite, ball, place, items, inside)` for each sphere at each row of a tile that its box
/// touches, by number, and stores what `words_of(row, items)` makes of the row.
template <class Twin, class A, class Row, class Draw, class Words>
void draw_spheres(const Twin& twin, const A& fp, const PassInput& in, std::size_t tiles, const Row& empty,
                  const Draw& draw, const Words& words_of, const WritableView& after) {
    const auto lane_fp = lanes_of(fp);
    using R = Lanes<std::remove_cvref_t<decltype(lane_fp)>>;
    R reading(lane_fp, (1U << lane_count) - 1);
    const auto& balls = twin.balls->of(fp, *twin.host, in.before, twin.spheres());
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
            std::optional<Ball<R>> wide;
            if (const auto& ball = balls[i]) {
                const auto& [x, y, z, w, middle_x, middle_y, half] = *ball;
                wide = Ball<R>{{x, y, z}, w, middle_x, middle_y, half};
            }
            return wide;
        },
        [&](Row& row, const Ball<R>& ball, const LanePixel& place, const LaneMask& inside) {
            draw(row, reading, sprite, ball, place, items_at(first_of(place)), inside);
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
