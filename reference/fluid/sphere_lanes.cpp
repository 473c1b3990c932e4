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

/// A sphere in a tile: what is the same in all of its rows.
template <class R> struct TileBall {
    Ball<R> ball;
    typename R::Real along_x, along_y; ///< of SpriteTwin::squared: of each column, and of each row
    typename R::Real window;           ///< of its middle
};

/// A row of a tile, with what is made of it.
template <class R, class Made> struct TileRow {
    typename R::Real scene; ///< scene_depth
    Made made;
};

/// Calls `draw(made, reading, sprite, ball, meeting, inside)` for each sphere at each row of a tile that it may cover,
/// by number, and stores what `words_of(made, items)` makes of the row.
template <class Twin, class A, class Made, class Draw, class Words>
void draw_spheres(const Twin& twin, const A& fp, const PassInput& in, std::size_t tiles, const Made& empty,
                  const Draw& draw, const Words& words_of, const WritableView& after) {
    const auto lane_fp = lanes_of(fp);
    using R = Lanes<std::remove_cvref_t<decltype(lane_fp)>>;
    using Row = TileRow<R, Made>;
    R reading(lane_fp, (1U << lane_count) - 1);
    const auto& balls = twin.balls->of(fp, *twin.host, in.before, twin.spheres());
    const SpriteTwin<R> sprite(reading, *twin.host, in.before, twin.spheres());
    const int width = twin.host->settings().width;
    const auto items_at = [&](const Pixel& place) {
        const int first = place.y * width + place.x, last = place.y * width + width - 1;
        const IntLanes behind = from(first);
        return LaneItems{behind > last ? lanes::all(last) : behind, lane_count};
    };
    const bool is_flat = twin.spheres().shape == Sphere::flat;
    draw_rows(
        twin.boxes, width, twin.host->settings().height, tiles,
        [&](const Pixel& place) {
            return Row{item_real(reading, site::scene_depth_in, in.before, field::scene_depth, items_at(place)), empty};
        },
        [&](std::uint32_t i, const Pixel& first) {
            std::optional<TileBall<R>> in_tile;
            if (!balls[i])
                return in_tile;
            const auto& [x, y, z, w, middle_x, middle_y, half] = *balls[i];
            const Ball<R> ball{{x, y, z}, w, middle_x, middle_y, half};
            const auto nx = sprite.from_middle_x(ball, from(first.x)), ny = sprite.from_middle_y(ball, from(first.y));
            const auto along_x = nx * nx;
            // Rounding keeps the order of sums: what lies beside the sprite in a column or a row is not covered.
            if (is_flat && everywhere(along_x > typename R::Real(1.0F)))
                return in_tile;
            in_tile = {ball, along_x, ny * ny, DepthCode<R>(reading, *twin.host).window(ball.centre.z)};
            return in_tile;
        },
        [&](Row& row, const TileBall<R>& in_tile, const LanePixel& place, const LaneMask& inside) {
            const float along_y = in_tile.along_y.v[place.y % lane_count];
            if (is_flat && along_y > 1.0F)
                return;
            draw(row.made, reading, sprite, in_tile.ball,
                 Meeting([&] { return place; }, [&] { return sprite.squared_of(in_tile.along_x, along_y); },
                         [&] { return in_tile.window; }, [&] { return row.scene; }),
                 inside);
        },
        [&](const Row& row, const Pixel& place, int count) {
            const IntLanes words = words_of(row.made, items_at(place));
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
        [&](Row& row, auto& r, const auto& sprite, const auto& ball, const auto& meets, const LaneMask& inside) {
            twin.offer(r, sprite, ball, meets, [&](const LaneMask& condition, const auto& key, const auto& stored) {
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
        [&](Row& row, auto& r, const auto& sprite, const auto& ball, const auto& meets, const LaneMask& inside) {
            twin.addend(r, sprite, ball, meets, [&](const LaneMask& covered, const auto& t) {
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
