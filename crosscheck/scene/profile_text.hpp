#pragma once
#include <string>
#include <vector>

#include "reference/model/collision/switches.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// For a reader of a verdict: which fragment stages leave the rounding of what they store to the driver.
std::vector<std::string> conversion_notes(const Profile& profile, const Switches& switches);

/// One line: "llvmpipe: dot x + (y + z), division and roots rounded, subnormals flushed, 8 sub-pixel bits, ..."
std::string describe(const Profile& profile);

} // namespace lockstep
