#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace lockstep {

/// What invocations appended to a buffer in an order that nothing fixes: a multiset. `may` lists, for each item found,
/// the invocations that may have appended it; each invocation appends one item at most, those in `must` one in any
/// case.
struct Appended {
    std::size_t invocations = 0;
    std::vector<std::uint32_t> must;
    std::vector<std::vector<std::uint32_t>> may;
};

/// Why a buffer is none that the invocations can have made: an item without an invocation left for it, or an invocation
/// whose item is missing.
struct WrongAppend {
    std::optional<std::size_t> item;
    std::optional<std::uint32_t> missing;
};

/// Nothing where each item can be given an invocation of its own, so that none is left that must have appended. By
/// Mendelsohn and Dulmage's theorem it is enough that the items can be matched, and those that must, each by
/// themselves.
std::optional<WrongAppend> wrong_append(const Appended& appended);

} // namespace lockstep
