#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reference/arithmetic.hpp"
#include "reference/collision/block_arithmetic.hpp"
#include "reference/collision/stored_positions.hpp"
#include "reference/packed_roots.hpp"
#include "reference/portable.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {

/// The listing's search (lines 5 to 19) of many particles: squared distances on vectors, and a root only where squares
/// alone do not decide. A root need not rise with its square everywhere (PackedRoots::sqrt_error), nor are tiny squares
/// flushed on the way: where those may count, the neighbours are gone through as the listing does.

/// Radii the search is compiled for.
constexpr int widest_fast_radius = 8;

/// Distances as the step's arithmetic has them, one by one.
struct Lengths {
    bool exact = false; ///< Portable; else
    DotOrder order{};
    const PackedRoots* tables = nullptr; ///< null: roots are rounded

    [[nodiscard]] float root(float square) const {
        return tables != nullptr ? tables->sqrt(square) : std::sqrt(square);
    }
    [[nodiscard]] float operator()(glm::vec3 v) const {
        return exact ? Portable::length(v) : root(dot_in(order, v, v));
    }
    [[nodiscard]] glm::vec3 flushed(glm::vec3 v) const { return exact ? Portable::flush(v) : v; }
    /// The largest relative error of a root.
    [[nodiscard]] double error() const { return tables != nullptr ? tables->sqrt_error() : 0x1p-24; }
};

/// What is a hit: a length below `limit`.
struct SearchRange {
    float limit;      ///< of lengths: the collision range, or the listing's first best distance
    float within;     ///< no larger square is a hit; negative: none is
    float surely;     ///< every square up to it is one
    float spread;     ///< of squares in a larger ratio the larger has the larger root
    bool zero_counts; ///< distance 0 is a hit, too

    /// Squares below this are not exact where the arithmetic flushes; all others are.
    static constexpr float tiny = 0x1p-90F;

    SearchRange(const Lengths& lengths, float range, bool zero_counts_)
        : limit(range < 100000.0F ? range : 100000.0F), zero_counts(zero_counts_) {
        const double off = 4.0 * lengths.error() + 0x1p-21, square = static_cast<double>(limit) * limit;
        spread = static_cast<float>(1.0 + off + 0x1p-22);
        within = range > 0.0F ? std::max(tiny, static_cast<float>(square * (1.0 + off))) : -1.0F;
        surely = static_cast<float>(square * (1.0 - off));
    }
};

namespace search_fast {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The texels around a base texel, rows padded to a multiple of four. The centre and the padding do not count.
template <int radius> struct Neighbourhood {
    static constexpr int rows = 2 * radius + 1;
    static constexpr int lanes = (rows + 3) / 4 * 4;
    static constexpr int size = rows * lanes;

    /// Added to a squared distance: infinite where the texel does not count, else 0.
    alignas(64) static constexpr std::array<float, size> aside = [] {
        std::array<float, size> a{};
        for (int i = 0; i < size; ++i)
            a[i] = i % lanes < rows && i != radius * lanes + radius ? 0.0F : infinity;
        return a;
    }();
};

/// A row of squared distances.
struct Row {
    const float *x, *y, *z, *aside;
    float* squared;
    int lanes;
};

template <DotOrder order> void squares_of_row(OneOrder<order> sums, glm::vec3 self, const Row& row) {
    const float *x = row.x, *y = row.y, *z = row.z, *aside = row.aside;
    float* squared = row.squared;
    LOCKSTEP_VECTOR_LOOP
    for (int lane = 0; lane < row.lanes; ++lane)
        squared[lane] = sums.length_square(self - glm::vec3{x[lane], y[lane], z[lane]}) + aside[lane];
}

template <DotOrder order> LOCKSTEP_VECTOR_CLONES void squares_in_order(glm::vec3 self, const Row& row) {
    squares_of_row(OneOrder<order>(), self, row);
}

inline void squares_of_row(OwnSums sums, glm::vec3 self, const Row& row) {
    static constexpr std::array<void (*)(glm::vec3, const Row&), 11> in_order{
        squares_in_order<DotOrder::left_to_right>,    squares_in_order<DotOrder::right_to_left>,
        squares_in_order<DotOrder::fused_chain>,      squares_in_order<DotOrder::middle_last>,
        squares_in_order<DotOrder::fused_from_z>,     squares_in_order<DotOrder::fused_y_x_z>,
        squares_in_order<DotOrder::fused_y_z_x>,      squares_in_order<DotOrder::sum_then_fused_z>,
        squares_in_order<DotOrder::sum_then_fused_x>, squares_in_order<DotOrder::fused_then_plus_z>,
        squares_in_order<DotOrder::x_plus_fused>};
    in_order[static_cast<std::size_t>(sums.length)](self, row);
}

/// The least of a neighbourhood's values, NaN passed over: column by column, then the columns four by four.
template <class N, class T> T least_of(const T* values, T most) {
    alignas(64) std::array<T, N::lanes> columns;
    columns.fill(most);
    for (int row = 0; row < N::rows; ++row, values += N::lanes) {
        LOCKSTEP_VECTOR_LOOP
        for (int lane = 0; lane < N::lanes; ++lane) {
            const T value = values[lane], so_far = columns[lane];
            columns[lane] = value < so_far ? value : so_far;
        }
    }
    for (int four = 4; four < N::lanes; four += 4)
        for (int lane = 0; lane < 4; ++lane)
            columns[lane] = std::min(columns[lane], columns[four + lane]);
    return std::min(std::min(columns[0], columns[1]), std::min(columns[2], columns[3]));
}

/// The first of the least root, which the least square has, or one so close that its root has to be looked at.
template <class N> int first_nearest(const Lengths& lengths, const float* squared, float least, float close) {
    alignas(64) std::array<std::int32_t, N::size> index;
    std::int32_t others = 0;
    LOCKSTEP_VECTOR_LOOP
    for (int i = 0; i < N::size; ++i) {
        index[i] = squared[i] == least ? i : N::size;
        others += (squared[i] <= close) & (squared[i] != least) ? 1 : 0;
    }
    int nearest = least_of<N, std::int32_t>(index.data(), N::size);
    if (others == 0)
        return nearest;
    float length = lengths.root(least);
    for (int i = 0; i < N::size; ++i)
        if ((squared[i] <= close) & (squared[i] != least))
            if (const float other = lengths.root(squared[i]); other < length || (other == length && i < nearest)) {
                length = other;
                nearest = i;
            }
    return nearest;
}

template <class N> bool has_tiny(const float* squared) {
    std::int32_t count = 0;
    LOCKSTEP_VECTOR_LOOP
    for (int i = 0; i < N::size; ++i)
        count += (squared[i] < SearchRange::tiny) & (squared[i] != 0.0F) ? 1 : 0;
    return count > 0;
}

} // namespace search_fast

/// A search in which no texel is a hit.
constexpr std::ptrdiff_t no_hit = -1;

/// The same by the listing; `corner`: the neighbourhood's first texel.
[[gnu::noinline]] inline std::ptrdiff_t nearest_by_listing(const Lengths& lengths, const SearchRange& range,
                                                           const StoredPositions& stored, glm::vec3 self,
                                                           std::ptrdiff_t corner, int radius) {
    std::ptrdiff_t nearest = no_hit;
    float least = range.limit;
    for (int y = 0; y <= 2 * radius; ++y)
        for (int x = 0; x <= 2 * radius; ++x) {
            const std::ptrdiff_t texel = corner + y * stored.stride + x;
            const float length = lengths(lengths.flushed(self - lengths.flushed(stored.at(texel))));
            if ((x == radius && y == radius) || !(length < least) || (length == 0.0F && !range.zero_counts))
                continue;
            least = length;
            nearest = texel;
        }
    return nearest;
}

/// Index of the texel that `self` collides with, or no_hit. `corner`: the neighbourhood's first texel.
template <int radius, class Sums> std::ptrdiff_t nearest_fast(Sums sums, const Lengths& lengths,
                                                              const SearchRange& range, const StoredPositions& stored,
                                                              glm::vec3 self, std::ptrdiff_t corner) {
    using namespace search_fast;
    using N = Neighbourhood<radius>;
    alignas(64) std::array<float, N::size> squared;
    for (int row = 0; row < N::rows; ++row) {
        const std::ptrdiff_t first = corner + row * stored.stride;
        squares_of_row(sums, self,
                       {stored.x.get() + first, stored.y.get() + first, stored.z.get() + first,
                        N::aside.data() + row * N::lanes, squared.data() + row * N::lanes, N::lanes});
    }
    float least = least_of<N>(squared.data(), infinity);
    if (least == 0.0F && !range.zero_counts) { // a square of 0 is a distance of 0 in every arithmetic
        LOCKSTEP_VECTOR_LOOP
        for (float& square : squared)
            square = square == 0.0F ? infinity : square;
        least = least_of<N>(squared.data(), infinity);
    }
    if (!(least <= range.within))
        return no_hit;
    if (least < SearchRange::tiny && (least != 0.0F || has_tiny<N>(squared.data())))
        return nearest_by_listing(lengths, range, stored, self, corner, radius);
    const int nearest = first_nearest<N>(lengths, squared.data(), least, least * range.spread);
    if (!(least <= range.surely) && !(lengths.root(squared[nearest]) < range.limit))
        return no_hit;
    return corner + nearest / N::lanes * stored.stride + nearest % N::lanes;
}

} // namespace lockstep
