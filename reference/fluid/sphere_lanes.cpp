#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "reference/fluid/sphere_depth_twin.hpp"
#include "reference/fluid/thickness_twin.hpp"
#include "reference/system/tile_rows.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

using BallNumbers = DrawnBalls::Numbers;
using AllBalls = std::vector<std::optional<BallNumbers>>;

/// A sphere in a tile: what is the same in all of its rows.
template <class R> struct TileBall {
    Ball<R> ball;
    typename R::Real along_x; ///< of SpriteTwin::squared: of each column
    typename R::Real window;  ///< of its middle
};

/// A row of a tile, with what is made of it.
template <class R, class Made> struct TileRow {
    typename R::Real scene; ///< scene_depth
    Made made;
};

/// Draws each sphere at each row of a tile that it may cover, as `pass` does it (NearestSpheres, AddedSpheres), and
/// stores what it makes of the row.
template <class Twin, class A, class F, class Pass> void draw_spheres(const Twin& twin, const A& fp, const F& lane_fp,
                                                                      const PassInput& in, std::size_t tiles,
                                                                      Pass& pass, const WritableView& after) {
    using R = Lanes<F>;
    using Row = TileRow<R, typename Pass::Made>;
    R reading(lane_fp, every_lane);
    const AllBalls& balls = twin.balls->of(fp, *twin.host, in.before, twin.spheres());
    const SpriteTwin<R> sprite(reading, *twin.host, in.before, twin.spheres());
    const int width = twin.host->settings().width;
    const auto items_at = [&](const Pixel& place) {
        const int first = place.y * width + place.x, last = place.y * width + width - 1;
        const IntLanes behind = from(first);
        return LaneItems{behind > last ? lanes::all(last) : behind, lane_count};
    };
    const bool is_flat = twin.spheres().shape == Sphere::flat;
    std::array<float, BoxesByTile::tile_height> along_ys{}; ///< SpriteTwin::squared of each row, of the sphere in hand
    draw_rows(
        twin.boxes, width, twin.host->settings().height, tiles,
        [&](std::span<const std::uint32_t> near) { return pass.ordered(balls, near); },
        [&](const Pixel& place) {
            return Row{item_real(reading, site::scene_depth_in, in.before, field::scene_depth, items_at(place)),
                       pass.nothing()};
        },
        [&](std::uint32_t i, const Pixel& first, const auto& rows) {
            std::optional<TileBall<R>> in_tile;
            if (!balls[i] || !pass.may_show(*balls[i], rows))
                return in_tile;
            const auto& [x, y, z, window, middle_x, middle_y, half] = *balls[i];
            const Ball<R> ball{{x, y, z}, -z, middle_x, middle_y, half};
            const auto nx = sprite.from_middle_x(ball, from(first.x)), along_x = nx * nx;
            // Rounding keeps the order of sums: what lies beside the sprite in a column or a row is not covered.
            if (is_flat && everywhere(along_x > typename R::Real(1.0F)))
                return in_tile;
            for (int row = 0; row < BoxesByTile::tile_height; row += lane_count) {
                const auto ny = sprite.from_middle_y(ball, from(first.y + row)), along_y = ny * ny;
                std::memcpy(&along_ys[static_cast<std::size_t>(row)], &along_y.v, sizeof along_y.v);
            }
            in_tile = {ball, along_x, window};
            return in_tile;
        },
        [&](Row& row, const TileBall<R>& in_tile, const LanePixel& place, const LaneMask& inside) {
            const float along_y = along_ys[static_cast<unsigned>(place.y) % BoxesByTile::tile_height];
            pass.draw(row.made, reading, sprite, in_tile.ball,
                      Meeting([&] { return place; }, [&] { return sprite.squared_of(in_tile.along_x, along_y); },
                              [&] { return in_tile.window; }, [&] { return row.scene; }),
                      inside);
        },
        [&](const Row& row, const Pixel& place, int count) {
            const IntLanes words = pass.words(row.made, items_at(place));
            std::memcpy(after.columns[0] + (static_cast<std::size_t>(place.y) * static_cast<std::size_t>(width) +
                                            static_cast<std::size_t>(place.x)) *
                                               sizeof(float),
                        &words, static_cast<std::size_t>(count) * sizeof(float));
        });
}

/// The depth of the nearest sphere. Whatever the order, it is the same: what is compared equal is stored equal.
template <class A> class NearestSpheres {
  public:
    struct Made {
        FloatLanes key, stored;
    };
    NearestSpheres(const SphereDepthTwin& twin, const A& fp)
        : twin_(twin), fp_(fp), code_(fp_, *twin.host), radius_(twin.spheres().radius),
          is_flat_(twin.spheres().shape == Sphere::flat) {}

    NearestSpheres(const NearestSpheres&) = delete;
    NearestSpheres& operator=(const NearestSpheres&) = delete;

    [[nodiscard]] Made nothing() const { return {lanes::all(1.0F), lanes::all(code_.empty())}; }
    /// Those that touch the nearest one's depths first: they hide most others.
    std::span<const std::uint32_t> ordered(const AllBalls& balls, std::span<const std::uint32_t> near) {
        float nearest = -HUGE_VALF;
        for (const std::uint32_t i : near)
            if (balls[i])
                nearest = std::max(nearest, balls[i]->z);
        const float front = nearest - 2.0F * radius_;
        order_.clear();
        behind_.clear();
        for (const std::uint32_t i : near)
            if (balls[i])
                (balls[i]->z >= front ? order_ : behind_).push_back(i);
        order_.insert(order_.end(), behind_.begin(), behind_.end());
        return order_;
    }
    /// Also of the rows that draw() gets next: what lies nearer there than all of this sphere.
    template <class Rows> bool may_show(const BallNumbers& ball, const Rows& rows) {
        least_key_ = least_key(ball.z);
        IntLanes may_be_nearer = lanes::all(0);
        for (const auto& row : rows)
            may_be_nearer |= row.made.key > least_key_;
        return lanes::set_of(may_be_nearer) != 0;
    }
    template <class R, class Meets> void draw(Made& made, R& r, const SpriteTwin<R>& sprite, const Ball<R>& ball,
                                              const Meets& meets, const LaneMask& inside) const {
        IntLanes may_be_nearer = inside.v & (made.key > least_key_);
        if (is_flat_)
            may_be_nearer &= meets.squared().v <= 1.0F;
        if (lanes::set_of(may_be_nearer) == 0)
            return;
        twin_.offer(r, sprite, ball, meets, [&](const LaneMask& condition, const auto& key, const auto& stored) {
            const IntLanes nearer = (inside && condition).v & (key.v < made.key);
            made.key = nearer ? key.v : made.key;
            made.stored = nearer ? stored.v : made.stored;
        });
    }
    static IntLanes words(const Made& made, const LaneItems& /*items*/) { return lanes::bits(made.stored); }

  private:
    /// Less than what the depth test compares, wherever a sphere is met: its nearest point's, by more than rounding and
    /// a code of the depth can be. Nothing is known of one that comes near the camera.
    float least_key(float centre_z) {
        constexpr float more_than_rounding = 0x1p-18F;
        const float nearest = centre_z * (1.0F - 0x1p-16F) + radius_ * 1.001F;
        if (!(nearest < -0.5F * twin_.host->near_plane()))
            return -1.0F;
        const typename Values<A>::Real z(nearest);
        return static_cast<float>(code_.tested(z, code_.stored(z))) - more_than_rounding;
    }

    const SphereDepthTwin& twin_;
    Values<A> fp_;
    DepthCode<Values<A>> code_;
    float radius_;
    bool is_flat_;
    float least_key_ = 0.0F; ///< of the sphere that is drawn
    std::vector<std::uint32_t> order_, behind_;
};

/// How thick all spheres are together, added up by number.
class AddedSpheres {
  public:
    struct Made {
        FloatLanes sum;
        IntLanes units;
    };
    AddedSpheres(const ThicknessTwin& twin, const SystemView& before) : twin_(twin), before_(before) {}

    [[nodiscard]] static Made nothing() { return {lanes::all(0.0F), lanes::all(0)}; }
    static std::span<const std::uint32_t> ordered(const AllBalls& /*balls*/, std::span<const std::uint32_t> near) {
        return in_their_order(near);
    }
    template <class Rows> static bool may_show(const BallNumbers& /*ball*/, const Rows& /*rows*/) { return true; }
    template <class R, class Meets> void draw(Made& made, R& r, const SpriteTwin<R>& sprite, const Ball<R>& ball,
                                              const Meets& meets, const LaneMask& inside) const {
        twin_.addend(r, sprite, ball, meets, [&](const LaneMask& covered, const auto& t) {
            const IntLanes adds = (inside && covered).v;
            if (twin_.is_fixed())
                made.units += adds & __builtin_convertvector(t.v, IntLanes);
            else
                made.sum = adds ? r.arithmetic().flush(made.sum + t.v) : made.sum;
        });
    }
    [[nodiscard]] IntLanes words(const Made& made, const LaneItems& items) const {
        return twin_.is_fixed() ? lanes::bits(lane_floats(before_, field::thickness, items, 0)) + made.units
                                : lanes::bits(made.sum);
    }

  private:
    const ThicknessTwin& twin_;
    const SystemView& before_;
};

template <class A> void depth_row(const SphereDepthTwin& twin, const A& fp, const PassInput& in, std::size_t tiles,
                                  const WritableView& after) {
    NearestSpheres<A> pass(twin, fp);
    with_lanes_of(fp, [&](const auto& lane_fp) { draw_spheres(twin, fp, lane_fp, in, tiles, pass, after); });
}
template <class A> void thickness_row(const ThicknessTwin& twin, const A& fp, const PassInput& in, std::size_t tiles,
                                      const WritableView& after) {
    const AddedSpheres pass(twin, in.before);
    with_lanes_of(fp, [&](const auto& lane_fp) { draw_spheres(twin, fp, lane_fp, in, tiles, pass, after); });
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
