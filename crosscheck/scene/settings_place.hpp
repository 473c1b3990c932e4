#pragma once
#include <string>

#include "crosscheck/files/json_reader.hpp"

namespace lockstep {

/// Throws Error: `message`, which a check of a scene's settings gave, with the place of what it speaks of. From word to
/// word, that is the only key of that name below the last one found, the object or list of that number, or the x, y or
/// z of a vector. A message that speaks of no key has the file alone.
[[noreturn]] void fail_settings(const JsonValue& scene, const std::string& message);

} // namespace lockstep
