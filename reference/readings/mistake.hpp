#pragma once
#include <algorithm>
#include <any>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/readings/site.hpp"

namespace lockstep {

/// What can be done wrong at a site.
enum class Change : std::uint8_t {
    none,
    // A value, or one component of it.
    zero,
    one,
    negated,
    doubled,
    halved,
    reciprocal,
    opposite, ///< 1 - x
    one_more,
    one_less,
    half_more,
    half_less,
    swapped,      ///< x and y
    x_everywhere, ///< x for every component
    instead,      ///< another site's value, as it last was
    plus,         ///< that added, and so on
    minus,
    times,
    yz_swapped,
    xz_swapped,
    rotated,      ///< y, z, x
    rotated_back, ///< z, x, y
    by_formula,   ///< what the system says (Mistake::formula)
    spoiled,      ///< likewise, to the very bits
    // By formula, as well: a condition, a loop, a fetch, a choice.
    decided_by_formula,
    ranged_by_formula,
    fetched_by_formula,
    chosen_by_formula,
    found_by_formula,
    // A condition, or one comparison of it.
    inverted,
    always,
    never,
    or_equal, ///< <= for <, < for <=
    reversed, ///< > for <
    dropped,
    differs,       ///< != for < and <=
    at_most,       ///< <= for ==
    at_least,      ///< >= for ==
    left_zero,     ///< the operand on the left is 0
    right_zero,    ///< the one on the right
    right_doubled, ///< and so on
    right_halved,
    and_is_or,
    // A condition or a fetch in a loop: what its answer ends. A fetch answers yes where there is a texel.
    loop_left_if_so,
    loop_left_if_not,
    loops_left_if_so, ///< all that it stands in
    loops_left_if_not,
    // A loop.
    first_skipped,
    last_skipped,
    first_alone,
    last_alone,
    first_half, ///< and the middle
    last_half,
    every_second, ///< from the first
    backwards,
    // A fetch of a texel outside.
    outside_is_edge,
    outside_is_other_side,
    outside_is_zero,
    // An operation.
    not_done,   ///< normalize, divide
    transposed, ///< a matrix
    squared,    ///< a length, and so on
    sum_of_magnitudes,
    without_x,
    without_y,
    without_z,
    // A choice of the least.
    last_taken,
    first_taken,
    greatest_taken,
    last_of_equals,
    compared_with_first, ///< the last that is less than the first
    second_least,        ///< where there are two
    compared_with_last,  ///< the last that is less than the one before it
    one_a_turn,          ///< after one that was taken, none before the next loop begins
    added_up,            ///< what was found is the sum of all
    units_added_up,      ///< of all as unit vectors
    improving_added_up,  ///< of those that were the least so far
    improving_units_added_up,
    // Of the whole pass, at no site: its arithmetic.
    sums_left_to_right,
    sums_right_to_left,
    sums_fused,
    products_fused, ///< of twins that say so (item_twin.hpp)
    portable_arithmetic,
    subnormals_kept,
    // What its host does.
    item_kept,  ///< the item stays as it was
    handed_over ///< what the twin says (Mistake::part)
};
/// "negated"
std::string_view change_name(Change change);

/// What a run has come by: each site's values as they last were. A condition has its left operands, a fetch the texel.
class CameBy {
  public:
    static constexpr std::size_t most_values = 4;

    void keep(std::uint32_t site, std::span<const float> values);
    /// The values kept, 0 where there are none.
    [[nodiscard]] const std::array<float, most_values>& of(const Site& site) const;
    [[nodiscard]] bool has(const Site& site) const { return find(site.id) != nullptr; }
    /// As they were when what is chosen so far was offered; if nothing is, as they last were.
    [[nodiscard]] const std::array<float, most_values>& of_chosen(const Site& site) const {
        return chosen == nullptr ? of(site) : chosen->of(site);
    }

    /// What the system foretold of this type (Mistaken::foretell), which it has to be.
    template <class World> [[nodiscard]] const World& foretold() const { return *std::any_cast<const World*>(world); }

    std::any world;       ///< a pointer to it
    std::size_t item = 0; ///< whose run it is
    const CameBy* chosen = nullptr;
    int offered = 0; ///< how many the choice could be made of
    int taken = 0;   ///< of these, how many were the least so far
    std::array<float, 3> constants{};

  private:
    struct Kept {
        std::uint32_t site = 0;
        std::array<float, most_values> values{};
    };
    static constexpr std::size_t places = 128;
    [[nodiscard]] const Kept* find(std::uint32_t site) const;
    std::array<Kept, places> kept_{}; ///< by site, in the next free place
};

/// A wrong way to compute, as the system says it: changes in place
/// - a value's components, as they would have been;
/// - of a condition its answer, followed by both operands of each comparison;
/// - a loop's first, last and step;
/// - a fetch's x and y, followed by the image's width and height;
/// - the key by which one is chosen, followed by a second one, 0, by which one is chosen among equals;
/// - of what was chosen, 1: whether it counts.
using Formula = void (*)(std::span<float> value, const CameBy& run);

/// One change of a twin at one site.
struct Mistake {
    std::uint32_t site = 0;
    Change change = Change::none;
    int part = -1;            ///< component, or comparison; -1: the whole
    std::uint32_t source = 0; ///< the site whose value is taken
    Formula formula = nullptr;
    std::array<float, 3> constants{}; ///< of the formula
    const Mistake* also = nullptr;    ///< made together with it

    bool operator==(const Mistake&) const = default;

    /// Whether it is one of the pass's arithmetic: what it changes is rounding.
    [[nodiscard]] bool is_about_rounding() const {
        return change >= Change::sums_left_to_right && change <= Change::subnormals_kept;
    }
    /// Whether it is written in one way among many, that round otherwise.
    [[nodiscard]] bool rounds() const {
        return also != nullptr || (formula != nullptr && change != Change::spoiled) ||
               (change >= Change::one_a_turn && change <= Change::improving_units_added_up);
    }
};

inline bool is_among(Change change, std::span<const Mistake> made) {
    return std::any_of(made.begin(), made.end(), [&](const Mistake& m) { return m.change == change; });
}

/// As data: a change at a site, of its part `part` or the whole, by the value of `source`.
inline Mistake mistake_at(const Site& site, Change change, int part = -1, const Site* source = nullptr) {
    return {.site = site.id, .change = change, .part = part, .source = source == nullptr ? 0 : source->id};
}

/// What a run came by at a site: enough to say what can be done wrong there.
struct SeenSite {
    enum class Kind : std::uint8_t {
        value,
        whole_value, ///< of integers
        condition,
        setting,
        loop,
        fetch,
        length,
        optional_operation, ///< can be left out: normalize, divide
        matrix,
        choice
    };
    const Site* site;
    Kind kind;
    int size = 1;  ///< components, or comparisons
    int loops = 0; ///< that it stands in

    bool operator==(const SeenSite&) const = default;
};

/// Every mistake that can be made at the sites a run came by, in the order it came by them.
std::vector<Mistake> mistakes_at(std::span<const SeenSite> sites);

/// "nearest: part 1 reversed", "fall: instead u_Gravity".
std::string mistake_text(const Mistake& mistake, std::span<const SeenSite> sites);

} // namespace lockstep
