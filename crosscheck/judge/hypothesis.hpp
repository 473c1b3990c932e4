#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/judge/item_likeness.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// What may have gone wrong in a pass, and what it explains.
struct Hypothesis {
    enum class Host : std::uint8_t { none, unwritten, earlier_state, fields_swapped, field_kept };
    Host host = Host::none;
    std::vector<Mistake> made = {};                ///< none: the host's
    std::vector<const NamedMistake*> named = {};   ///< of each that is made; none: it has no name
    const NamedMistake* alike = nullptr;           ///< the named one that is this very change, held to rounding here
    std::string text = {};                         ///< of one without a name; or the named one's constants
    std::array<std::uint8_t, 2> fields = {};       ///< of the host's mistake
    bool loosely = false;                          ///< need only come near, whatever is made
    std::uint64_t explained = 0, contradicted = 0; ///< divergent items; ones that agree, and would not
    std::uint64_t distinct = 0;                    ///< of those that it has right, which no description has
    std::uint64_t telling = 0;                     ///< of those explained, which are off by more than rounding
    std::uint64_t equal = 0;                       ///< of those explained, which have the very bits

    /// Whether it need only come near: a formula may be written in other orders.
    [[nodiscard]] bool rounds() const;
    /// Names first, those with constants of their own after the others; then the host's, then a wrong input, then all
    /// else.
    [[nodiscard]] int rank() const;
    [[nodiscard]] std::int64_t balance() const {
        return static_cast<std::int64_t>(explained) - static_cast<std::int64_t>(contradicted);
    }
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] std::string meaning() const;
};

/// Those that a pass's divergent items allow: the named ones, of one with constants as many as it has; the host's; and
/// every change at the items' sites, by the name it has among `exact`.
std::vector<Hypothesis> hypotheses_of(const std::vector<const NamedMistake*>& named,
                                      const std::vector<const NamedMistake*>& exact, const JudgedPass& pass,
                                      const std::vector<std::size_t>& items);

/// Whether an item that is right cannot be so if the hypothesis holds.
bool contradicts(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item);

/// Whether an item came out as the hypothesis has it, to the last bit.
bool has_bits(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item);

/// Whether an item came out as the hypothesis has it.
bool explains(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item);

} // namespace lockstep
