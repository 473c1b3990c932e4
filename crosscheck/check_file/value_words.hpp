#pragma once
#include <cstdint>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/schema.hpp"
#include "reference/text/program.hpp"

namespace lockstep::check_file {

/// What a component of the type is as a word of a state. A bool is a uint.
Scalar scalar_of(const text::BasicType& type);

/// The bits of a number of the file. Throws Error as JsonValue does.
std::uint32_t read_word(const JsonValue& value, Scalar scalar);

/// The bits of a number that was computed; one for integers is rounded down.
std::uint32_t word_of(double number, Scalar scalar);

} // namespace lockstep::check_file
