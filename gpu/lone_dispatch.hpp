#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep {

/// A compute stage by itself with all that it is bound to, by the names that its text has. What is not active in it is
/// left out.
struct LoneDispatch {
    struct Block {
        std::string name;
        bool is_storage = true;
        std::size_t buffer = 0; ///< whose words; several blocks may have one
    };
    struct Uniform {
        std::string name; ///< of a number, vector or matrix, or of an array of these: weights[0]
        std::vector<std::uint32_t> words;
    };
    struct Image {
        std::string name;
        bool is_storage = false; ///< an image, not a sampler, which reads the nearest texel
    };
    std::array<std::uint32_t, 3> groups{1, 1, 1};
    std::vector<std::vector<std::uint32_t>> buffers;
    std::vector<Block> blocks;
    std::vector<Uniform> uniforms;
    std::vector<Image> images; ///< as many as `texels` has resources
    SystemState texels;
};

/// Runs it in the current context, of GL 4.3 or later. Its storage buffers and images are then as the GPU left them.
/// Throws Error where the driver does not take the shader, or has not as many bindings.
void run_alone(LoneDispatch& dispatch, const ShaderSource& stage);

} // namespace lockstep
