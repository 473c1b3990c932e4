#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// Largest neighbourhood radius, texels.
inline constexpr std::int64_t widest_neighbourhood = 64;

/// The names scene files and --set give the Constants.
std::span<const std::string_view> constant_names();

/// Sets the constant `name`, one of constant_names(). Throws Error saying what it may be.
void set_constant(Constants& constants, std::string_view name, const JsonValue& value);

/// Sets those that an object names.
void read_constants(const JsonValue& json, Constants& constants);

/// All of them by these names.
nlohmann::json constants_json(const Constants& constants);

} // namespace lockstep
