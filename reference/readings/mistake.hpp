#pragma once
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
    spoiled, ///< what the system says (Mistake::spoil)
    // A condition, or one comparison of it.
    inverted,
    always,
    never,
    or_equal, ///< <= for <, < for <=
    reversed, ///< > for <
    dropped,
    and_is_or,
    // A loop.
    first_skipped,
    last_skipped,
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
};
/// "negated"
std::string_view change_name(Change change);

/// One change of a twin at one site.
struct Mistake {
    std::uint32_t site = 0;
    Change change = Change::none;
    int part = -1;            ///< component, or comparison; -1: the whole
    std::uint32_t source = 0; ///< the site whose value is taken
    /// Of Change::spoiled: changes the components.
    void (*spoil)(std::span<float> value, const void* context) = nullptr;
    const void* context = nullptr;

    bool operator==(const Mistake&) const = default;
};

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
    int size = 1; ///< components, or comparisons

    bool operator==(const SeenSite&) const = default;
};

/// Every mistake that can be made at the sites a run came by, in the order it came by them.
std::vector<Mistake> mistakes_at(std::span<const SeenSite> sites);

/// "nearest: part 1 reversed", "fall: instead u_Gravity".
std::string mistake_text(const Mistake& mistake, std::span<const SeenSite> sites);

} // namespace lockstep
