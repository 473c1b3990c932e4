#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <spirv_glsl.hpp>

/// What reads a module's words, and what has spirv-cross write GLSL of them, share.
namespace lockstep {

inline constexpr std::size_t spirv_header_words = 5;

/// Walks through the instructions of a module: `each` gets an opcode and its words.
template <class Each> void for_each_instruction(std::span<const std::uint32_t> words, const Each& each) {
    for (std::size_t at = spirv_header_words; at < words.size();) {
        const std::size_t count = std::max<std::size_t>(words[at] >> 16U, 1);
        each(static_cast<spv::Op>(words[at] & 0xffffU), words.subspan(at, std::min(count, words.size() - at)));
        at += count;
    }
}

/// What goes from stage to stage does by its name.
inline void unset_locations(spirv_cross::CompilerGLSL& compiler, const spirv_cross::ShaderResources& all) {
    const spv::ExecutionModel model = compiler.get_execution_model();
    if (model != spv::ExecutionModelVertex)
        for (const spirv_cross::Resource& one : all.stage_inputs)
            compiler.unset_decoration(one.id, spv::DecorationLocation);
    if (model != spv::ExecutionModelFragment)
        for (const spirv_cross::Resource& one : all.stage_outputs)
            compiler.unset_decoration(one.id, spv::DecorationLocation);
}

} // namespace lockstep
