#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/text/text_pass.hpp"

namespace lockstep {

/// A line of a wrong shader that has no counterpart in the reference's text, as a report has it.
struct WitnessLine {
    std::string where; ///< FILE:LINE
    std::string text;  ///< of the line
    std::string what;  ///< what it gave of an item, and what would have been right there
};

/// Looks for the lines of `wrong` that make what the GPU made wrong, where its text makes it wrong, too: a dispatch of
/// both texts from one input, invocation by invocation (reference/text/alignment.hpp). At most three, the likeliest
/// first; none where too little speaks for any. `items` differ from the reference, `others` do not.
/// What lies in a file that is none of the user's, by is_own(FILE:LINE), counts as the call's line.
std::vector<WitnessLine> witness_lines(const PassText& wrong, const PassText& reference, const PassInput& in,
                                       const Profile& profile, std::uint8_t resource,
                                       std::span<const std::size_t> items, std::span<const std::size_t> others,
                                       const std::function<bool(std::string_view where)>& is_own);

} // namespace lockstep
