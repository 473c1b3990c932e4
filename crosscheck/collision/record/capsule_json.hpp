#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/collision/record/capsule.hpp"
#include "crosscheck/files/json_reader.hpp"

namespace lockstep {

/// A capsule as a file (docs/traces.md has the keys). Floats are eight hexadecimal digits, their bits. Reading it back
/// gives the same text and verdict. Throws Error if it would be larger than largest_capsule.
std::string capsule_file(const Capsule& capsule);

/// Throws Error naming the key and what it may be.
Capsule read_capsule(const JsonValue& json);

} // namespace lockstep
