#pragma once
#include <cstdint>
#include <optional>

#include "reference/interval.hpp"

namespace lockstep::text {

/// Words in a row, as an integer may be whose bits come of a set of floats: first, first + 1, up to first + more,
/// modulo 2^32.
struct WordRange {
    std::uint32_t first = 0, more = 0;

    friend bool operator==(const WordRange&, const WordRange&) = default;
    [[nodiscard]] std::uint32_t last() const { return first + more; }
    [[nodiscard]] bool contains(std::uint32_t word) const { return word - first <= more; }
    /// Whether the order of unsigned, or of signed numbers, is that of the words.
    [[nodiscard]] bool is_unsigned() const { return first <= last(); }
    [[nodiscard]] bool is_signed() const {
        return static_cast<std::int32_t>(first) <= static_cast<std::int32_t>(last());
    }
};

namespace word_range {

/// Whether `of` knows an operation: the instruction of a module, of integers.
bool is_known(std::uint32_t operation);
/// A range that holds all results, and perhaps more. Nothing where that is half of all words and more, or where it
/// takes to know which word an operand is; never of single words. `b`: of an operation with one operand without
/// meaning.
std::optional<WordRange> of(std::uint32_t operation, const WordRange& a, const WordRange& b);

/// What an atomic addition, minimum or maximum, by its instruction, makes of words in any order; nothing of others, or
/// where the words are no range of such numbers.
std::optional<WordRange> of_atomic(std::uint32_t operation, const WordRange& a, const WordRange& b);

/// The floats with these bits; nothing where one of them is no number, or where the signs differ.
std::optional<Interval> floats(const WordRange& a);
/// The bits of a set of floats that has numbers of one sign. Zero is +0 beside positive ones, and else -0.
std::optional<WordRange> bits(const Interval& set);

} // namespace word_range
} // namespace lockstep::text
