#include "reference/model/lifecycle/layout.hpp"

#include <array>

namespace lockstep::lifecycle {
namespace {

constexpr LayoutPlan bytes_112{28, true, false, false, true, 0, 4, 7, 15, 8, 21, 22, 3, 19, 23, 24, 12, 11, 16, 20};

constexpr LayoutPlan of_floats(std::size_t words) {
    return {words, true, false, false, false, 0, 3, 6, 7, 8, 11, -1, 12, 13, 14, 15, 16, -1, 17, -1};
}

/// Where what follows words 0 to 5 lies.
constexpr LayoutPlan of_halves(std::size_t words, bool half_sizes, bool half_lengths) {
    const int lengths = half_sizes ? 7 : 8, color = lengths + (half_lengths ? 1 : 2);
    return {words,      false,
            half_sizes, half_lengths,
            false,      -1,
            -1,         -1,
            -1,         -1,
            -1,         -1,
            6,          half_sizes ? 6 : 7,
            lengths,    half_lengths ? lengths : lengths + 1,
            color,      -1,
            color + 1,  -1};
}

constexpr std::array<LayoutPlan, 7> plans{bytes_112,
                                          of_floats(20),
                                          of_floats(18),
                                          of_halves(16, false, false),
                                          of_halves(12, false, false),
                                          of_halves(11, true, false),
                                          of_halves(10, true, true)};

} // namespace

bool LayoutPlan::is_float(std::size_t word) const {
    const auto w = static_cast<int>(word);
    if (words == 28)
        return w != order && w < 25;
    if (floats)
        return w < 16;
    return (!half_sizes && (w == size || w == end_size)) || (!half_lengths && (w == previous || w == start));
}

const LayoutPlan& plan_of(Layout layout) { return plans[static_cast<std::size_t>(layout)]; }

} // namespace lockstep::lifecycle
