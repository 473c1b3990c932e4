#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "crosscheck/text/fills.hpp"
#include "gpu/shader_source.hpp"
#include "reference/text/invocation.hpp"

namespace lockstep {

/// A run of one stage's text, on numbers that are made up.
struct Examination {
    std::filesystem::path file = {};
    std::filesystem::path reference = {};         ///< whose text it is compared with; empty: none
    std::array<std::uint32_t, 3> groups{4, 1, 1}; ///< of a compute stage
    /// Vertices, primitives or fragments of another stage, and their inputs by name, the same for all: numbers as they
    /// are typed, since their type is the text's.
    std::uint32_t invocations = 64;
    std::map<std::string, std::vector<std::string>> inputs = {};
    ShaderDefines defines = {};
    std::map<std::string, std::vector<std::string>> uniforms = {};
    std::map<std::string, std::vector<std::uint32_t>> uniform_words = {}; ///< of those that are known by their bits
    /// Elements of the array at a block's end, by the block's name; texels along each axis of an image.
    std::map<std::string, std::vector<std::uint32_t>> sizes = {};
    Fills fills = {};
    std::uint32_t seed = 1;
    std::uint32_t integers = 0;                        ///< integers of arrays and images are below it; 0: they are 0
    std::uint32_t subgroup_size = text::lanes_at_once; ///< at most so many
    bool is_watched = true;                            ///< looks for what the text leaves undefined, and for races
};

} // namespace lockstep
