#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <spirv.hpp>

namespace lockstep::text {

/// What an operation on integers or booleans makes of constants, component by component; null for other operations.
std::optional<std::vector<std::uint32_t>> constant_result(spv::Op op, std::uint32_t components,
                                                          std::span<const std::vector<std::uint32_t>> operands);

} // namespace lockstep::text
