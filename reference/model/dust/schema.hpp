#pragma once
#include "reference/model/schema.hpp"

namespace lockstep::dust {

/// Two buffers: the grains, in the source's three GL buffers, and one number, how many of them are alive.
const Schema& schema();

inline constexpr std::uint8_t grain_buffer = 0, count_buffer = 1;

namespace field {
inline constexpr FieldId position{grain_buffer, 0}, alive{grain_buffer, 1}, velocity{grain_buffer, 2};
inline constexpr FieldId colour{grain_buffer, 3}, alive_number{count_buffer, 0};
} // namespace field

} // namespace lockstep::dust
