#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace lockstep {

/// What a JSON text may ask for: far more than anything read here needs.
namespace json_limits {
inline constexpr std::size_t bytes = std::size_t{64} << 20U;
inline constexpr std::size_t depth = 64; ///< arrays and objects within each other
inline constexpr std::size_t values = 4'000'000;
} // namespace json_limits

/// All JSON from elsewhere is read here. Throws Error, `NAME:LINE:COLUMN: ...`, where the text is malformed, has a key
/// twice in one object, or is beyond the limits. A number with a fraction or an exponent is the double nearest to it;
/// where that lies halfway between two floats and the number does not, it is the neighbour on the number's side, so
/// that the double rounds to the float nearest to the number.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// The float nearest to a number of a JSON text, rounded once.
float nearest_float(const nlohmann::json& number);

/// A value in one line of at most 40 characters, for messages.
std::string shown_json(const nlohmann::json& value);

} // namespace lockstep
