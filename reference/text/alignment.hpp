#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reference/text/trace.hpp"

namespace lockstep::text {

/// A run of one invocation: what it came by, and what it wrote. Blocks and images are numbered alike in runs of two
/// texts.
struct TracedRun {
    Trace trace;
    std::vector<TracedWord> words;
};

/// A row of a wrong run that has no counterpart in the right one, though all that it was made of has.
struct Suspect {
    std::uint32_t row = 0;      ///< of the wrong run
    bool repairs = false;       ///< with the value below, or the other answer, all that the run writes is right
    bool is_output = false;     ///< it is written as it is: that its right value repairs it says little
    std::uint32_t repaired = 0; ///< the bits; of a comparison its other answer
};

/// What two runs of one invocation on the same state differ in. `again(forced)` is the wrong run with rows forced.
///
/// Runs are aligned by value and data flow: an operation has a counterpart where the right run came by its bits, a load
/// where it read that place, a comparison where it compared those numbers, 0 and small integers where they were made of
/// the same operands. From the words that are wrong, and from comparisons without a counterpart, it goes back through
/// rows without one; where all operands have one, the row is a suspect. Then each suspect gets the values that the
/// right run came by and the wrong one never did; components of a vector that are suspects get those of a vector.
/// `turns_all`: comparisons without a counterpart are turned whatever else repairs.
std::vector<Suspect> suspects_of(const TracedRun& wrong, const TracedRun& right,
                                 const std::function<std::vector<TracedWord>(std::span<const ForcedRow>)>& again,
                                 bool turns_all = false);

/// Rows of the right run that what it writes rests on and that have no counterpart in the wrong one, though all that
/// they were made of has: what the wrong text never computes.
std::vector<std::uint32_t> missing_rows(const TracedRun& right, const TracedRun& wrong);

/// The rows of a run that have no counterpart in another: what speaks against a suspect of their lines, where both runs
/// write the same.
std::vector<std::uint32_t> unmatched_rows(const TracedRun& run, const TracedRun& other);

} // namespace lockstep::text
