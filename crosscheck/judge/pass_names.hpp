#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// What names a pass that runs in a frame: its name, or its number among the system's passes, from 0, where one before
/// it has that name and runs as well.
std::string pass_argument(const System& system, std::size_t pass, int frame);

/// The pass of that name, of several the first that runs in the frame; or of that number. Throws Error, which begins
/// with `where` and names those there are.
std::size_t pass_named(const std::string& name, const System& system, int frame, std::string_view where);

} // namespace lockstep
