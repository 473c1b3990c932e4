#include "crosscheck/check_file/value_words.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lockstep::check_file {

Scalar scalar_of(const text::BasicType& type) {
    return type.is_real ? Scalar::float32 : type.is_signed ? Scalar::int32 : Scalar::uint32;
}

std::uint32_t read_word(const JsonValue& value, Scalar scalar) {
    switch (scalar) {
    case Scalar::float32:
        return std::bit_cast<std::uint32_t>(value.number());
    case Scalar::int32:
        return static_cast<std::uint32_t>(
            value.integer(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
    default:
        return static_cast<std::uint32_t>(value.integer(0, std::numeric_limits<std::uint32_t>::max()));
    }
}

std::uint32_t word_of(double number, Scalar scalar) {
    return scalar == Scalar::float32 ? std::bit_cast<std::uint32_t>(static_cast<float>(number))
           : scalar == Scalar::int32 ? static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(number)))
                                     : static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(number)));
}

} // namespace lockstep::check_file
