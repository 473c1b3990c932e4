#pragma once
#include <string>
#include <string_view>

#include "gpu/spirv_module.hpp"

namespace lockstep {

/// What a module declares, its words included, as one process hands it to another; the names need not be text.
std::string module_bytes(const SpirvModule& module);
SpirvModule module_of_bytes(std::string_view bytes);

} // namespace lockstep
