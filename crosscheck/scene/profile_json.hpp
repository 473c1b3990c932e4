#pragma once
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// A profile as data, all but the driver's tables (Profile::roots), and back to the same one. What a file leaves out is
/// that of named_profile(name), or strict's. Throws Error naming the key and what it may be.
nlohmann::json profile_json(const Profile& profile);
Profile read_profile(const JsonValue& json);

} // namespace lockstep
