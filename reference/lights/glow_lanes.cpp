#include <array>
#include <cstring>
#include <optional>

#include "reference/lights/glow_twin.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::lights {
namespace {

template <class A, class F> void glow_row(const GlowTwin& twin, const A& fp, const F& lane_fp, const PassInput& in,
                                          std::size_t tiles, const WritableView& after) {
    using R = Lanes<F>;
    struct Row {
        IntLanes is_lit{};
        std::array<FloatLanes, 3> sum{};
    };
    Values<A> one(fp);
    R reading(lane_fp, every_lane);
    const int width = twin.host->settings().width;
    const std::byte* before = in.before[field::pixel.resource].columns[field::pixel.field];
    const auto item_at = [&](const Pixel& place) { return item_of(place.x, place.y, width); };
    draw_rows(
        twin.boxes->of({}, *twin.host, in.before), width, twin.host->settings().height, tiles, in_their_order,
        [](const Pixel&) { return Row{}; },
        [&](std::uint32_t i, const Pixel&, const auto& /*rows*/) {
            std::optional<GlowTwin::Disc<R>> wide;
            const auto number = [](const auto& x) { return typename R::Real(static_cast<float>(x)); };
            if (const auto disc = twin.disc_of(one, in, i))
                wide = {i, {}, number(disc->depth), number(disc->x), number(disc->y), number(disc->radius)};
            return wide;
        },
        [&](Row& row, const GlowTwin::Disc<R>& disc, const LanePixel& place, const LaneMask& inside) {
            const auto first = static_cast<int>(item_at(first_of(place)));
            const IntLanes items = from(first), last = lanes::all(first + width - 1 - place.first);
            twin.offer(reading, in, disc, place, LaneItems{items > last ? last : items, lane_count},
                       [&](const LaneMask& covered, const auto& colour) {
                           const IntLanes adds = (inside && covered).v, fresh = adds & ~row.is_lit;
                           const std::array<FloatLanes, 3> terms{colour.x.v, colour.y.v, colour.z.v};
                           for (std::size_t c = 0; c < terms.size(); ++c) {
                               if (lanes::set_of(fresh) != 0) {
                                   const FloatLanes read = F::flush(
                                       lane_floats(in.before, field::pixel, {items > last ? last : items, lane_count},
                                                   static_cast<int>(c)));
                                   // In any order the sum begins at 0.
                                   row.sum[c] = fresh ? (twin.host->follows_driver() ? read : F::flush(0.0F + read))
                                                      : row.sum[c];
                               }
                               row.sum[c] = adds ? F::flush(row.sum[c] + terms[c]) : row.sum[c];
                           }
                           row.is_lit |= adds;
                       });
        },
        [&](const Row& row, const Pixel& place, int count) {
            std::array<float, 4 * lane_count> texels{};
            const std::size_t at = item_at(place) * 4 * sizeof(float),
                              bytes = static_cast<std::size_t>(count) * 4 * sizeof(float);
            std::memcpy(texels.data(), before + at, bytes);
            for (std::size_t k = 0; k < texels.size(); k += lane_count) {
                const FloatLanes read = F::flush(lanes::loaded<FloatLanes>(texels.data() + k));
                std::memcpy(texels.data() + k, &read, sizeof read);
            }
            for (int lane = 0; lane < count; ++lane)
                if (row.is_lit[lane] != 0)
                    for (std::size_t c = 0; c < row.sum.size(); ++c)
                        texels[static_cast<std::size_t>(lane) * 4 + c] = row.sum[c][lane];
            std::memcpy(after.columns[0] + at, texels.data(), bytes);
        });
}

} // namespace

LOCKSTEP_VECTOR_CLONES void draw_row(const GlowTwin& twin, const Portable& fp, const PassInput& in, std::size_t row,
                                     const WritableView& after) {
    with_lanes_of(fp, [&](const auto& lane_fp) { glow_row(twin, fp, lane_fp, in, row, after); });
}
LOCKSTEP_VECTOR_CLONES void draw_row(const GlowTwin& twin, const PlainArithmetic& fp, const PassInput& in,
                                     std::size_t row, const WritableView& after) {
    with_lanes_of(fp, [&](const auto& lane_fp) { glow_row(twin, fp, lane_fp, in, row, after); });
}

} // namespace lockstep::lights
