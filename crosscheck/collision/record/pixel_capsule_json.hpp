#pragma once
#include <string>

#include "crosscheck/collision/record/pixel_capsule.hpp"
#include "crosscheck/files/json_reader.hpp"

namespace lockstep {

/// As capsule_json.hpp has it of a particle's.
std::string capsule_file(const PixelCapsule& capsule);

/// Whether a JSON file is one of a pixel.
bool is_pixel_capsule(const JsonValue& json);

/// Throws Error naming the key and what it may be.
PixelCapsule read_pixel_capsule(const JsonValue& json);

} // namespace lockstep
