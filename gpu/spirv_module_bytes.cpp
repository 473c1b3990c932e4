#include "gpu/spirv_module_bytes.hpp"

#include <nlohmann/json.hpp>

namespace lockstep {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpirvModule::Variable, name, type, size, location, is_initialised, id, member)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BlockMember, name, type, offset, size, array_stride, matrix_stride, row_major,
                                   top_level_size, top_level_stride)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InterfaceBlock, name, binding, bytes, members)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpirvModule, file, words, entry_point, says_precise, calls_normalize,
                                   calls_inverse_sqrt, asks_length, inputs, outputs, uniforms, uniform_blocks,
                                   storage_blocks)

std::string module_bytes(const SpirvModule& module) {
    std::string bytes;
    nlohmann::json::to_cbor(nlohmann::json(module), bytes);
    return bytes;
}

SpirvModule module_of_bytes(std::string_view bytes) { return nlohmann::json::from_cbor(bytes).get<SpirvModule>(); }

} // namespace lockstep
