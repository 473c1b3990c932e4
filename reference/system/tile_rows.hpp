#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "reference/plain_arithmetic.hpp"
#include "reference/readings/lanes.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep {

/// What a pass's reading computes with.
template <class A> A arithmetic_of(const Values<A>& r) {
    struct Opened : Values<A> {
        explicit Opened(const Values<A>& of) : Values<A>(of) {}
        [[nodiscard]] A arithmetic() const { return this->fp_; }
    };
    return Opened(r).arithmetic();
}

/// Each operation as the plain arithmetic of a driver has it: with tables of roots lane by lane.
template <bool by_tables> struct OwnOrderLanes {
    using Three = Vec3<FloatLanes>;
    OwnOrders fp;

    LOCKSTEP_INLINE static FloatLanes flush(const FloatLanes& v) { return v; }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes divide(const FloatLanes& a, const FloatLanes& b) const {
        if constexpr (!by_tables) {
            return a / b;
        } else {
            FloatLanes made = a;
            for (int k = 0; k < lane_count; ++k)
                made[k] = fp.divide(a[k], b[k]);
            return made;
        }
    }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes sqrt(const FloatLanes& a) const {
        if constexpr (by_tables)
            return lanes::each(a, [this](float x) { return fp.sqrt(x); });
        else
            return lanes::sqrt(a);
    }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes dot(const Three& a, const Three& b) const {
        return PlainLanes::sum(fp.dot_order(), a, b);
    }
};

/// Calls `visit` with an arithmetic on lanes.
template <class Visit> void with_lanes_of(const Portable& /*fp*/, const Visit& visit) { visit(PortableLanes{}); }
template <class Visit> void with_lanes_of(const PlainArithmetic& fp, const Visit& visit) {
    if (fp.has_tables())
        visit(OwnOrderLanes<true>{fp});
    else
        visit(OwnOrderLanes<false>{fp});
}

/// For draw_rows: boxes by number.
inline std::span<const std::uint32_t> in_their_order(std::span<const std::uint32_t> boxes) { return boxes; }

/// BoxesByTile::draw, a row of a tile at a time, in each tile as `order(boxes)` has them. `begin(place)` makes a row,
/// and `make(i, place, rows)` what is drawn in a tile, from their first pixel. Then `draw(row, drawn, place, inside)`
/// for the pixels from `place` on that are `inside`, and `done(row, place, count)` with as many as lie in the image.
template <class Order, class Begin, class Make, class Draw, class Done>
void draw_rows(const BoxesByTile& boxes, int width, int height, std::size_t tiles, const Order& order,
               const Begin& begin, const Make& make, const Draw& draw, const Done& done) {
    constexpr int tile_width = BoxesByTile::tile_width, tile_height = BoxesByTile::tile_height;
    using Row = std::remove_cvref_t<std::invoke_result_t<Begin, Pixel>>;
    static_assert(tile_width == lane_count);
    const int y0 = static_cast<int>(tiles) * tile_height, y1 = std::min(y0 + tile_height, height);
    for (int x0 = 0; x0 < width; x0 += tile_width) {
        const int x1 = std::min(x0 + tile_width, width);
        std::array<Row, tile_height> rows;
        for (int y = y0; y < y1; ++y)
            rows[static_cast<std::size_t>(y - y0)] = begin(Pixel{x0, y});
        for (const std::uint32_t i : order(boxes.near({x0, y0}))) {
            const PixelRect& box = boxes.box(i);
            const IntLanes at = from(x0);
            const LaneMask inside((at >= box.x0) & (at < std::min(x1, box.x1)));
            const int last = std::min(y1, box.y1);
            if (const auto drawn = make(i, Pixel{x0, y0}, rows))
                for (int y = std::max(y0, box.y0); y < last; ++y)
                    draw(rows[static_cast<std::size_t>(y - y0)], *drawn, LanePixel{LaneInt(at), x0, y}, inside);
        }
        for (int y = y0; y < y1; ++y)
            done(rows[static_cast<std::size_t>(y - y0)], Pixel{x0, y}, x1 - x0);
    }
}

} // namespace lockstep
