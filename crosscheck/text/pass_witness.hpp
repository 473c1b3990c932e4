#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "crosscheck/text/text_pass.hpp"
#include "crosscheck/text/witness.hpp"

namespace lockstep {

/// witness_lines of a dispatch of both texts from one input: where the text makes wrong what the GPU made wrong.
/// `items` of `resource` differ from the reference, `others` do not.
std::vector<WitnessLine> witness_lines(const PassText& wrong, const PassText& reference, const PassInput& in,
                                       const Profile& profile, std::uint8_t resource,
                                       std::span<const std::size_t> items, std::span<const std::size_t> others,
                                       const std::function<bool(std::string_view where)>& is_own);

} // namespace lockstep
