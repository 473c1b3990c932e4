#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace lockstep {

/// What SPIRV-Tools finds wrong with a module, by the rules of the language alone, not by those of Vulkan or OpenGL;
/// empty: nothing.
std::string spirv_fault(std::span<const std::uint32_t> words);

} // namespace lockstep
