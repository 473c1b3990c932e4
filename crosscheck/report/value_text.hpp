#pragma once
#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/compare.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// How floats are written.
enum class NumberFormat { decimal, hexadecimal };

/// "0.1", nine digits, which no other float has; an integer "17".
std::string decimal_text(Value value);

/// "0x1.99999ap-4"; an integer "17".
std::string exact_text(Value value);

/// Either.
std::string value_text(Value value, NumberFormat format);

/// A number, or text where JSON has none for it.
nlohmann::json value_json(Value value);

/// "3 ULP"; of integers "3 apart".
std::string distance_text(std::int64_t distance, Scalar scalar = Scalar::float32);

/// The same of a difference; "other sign" of floats on two sides of 0, whose ULP say nothing.
std::string distance_text(const Difference& difference);

/// Whether the floats' distance is mostly that to 0 and back: `ulp` of more than an octave.
bool of_other_sign(float reference, float gpu, std::int64_t ulp);

/// "position.x: reference 1, GPU 1.00000012".
std::string difference_text(const Schema& schema, const Difference& difference);

/// "#3a6bd2", or with an alpha that is not 255 "#3a6bd2 alpha 0".
std::string color_text(Rgba8 color);

} // namespace lockstep
