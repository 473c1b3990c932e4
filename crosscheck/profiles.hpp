#pragma once
#include <string>

#include "reference/model/profile.hpp"

namespace lockstep {

class Context;

/// The profile that matches what the current context was measured to compute.
Profile measured_profile(const Context& context);

/// One line: "llvmpipe: dot x+(y+z), subnormals flushed, 8 sub-pixel bits, ..."
std::string describe(const Profile& profile);

} // namespace lockstep
