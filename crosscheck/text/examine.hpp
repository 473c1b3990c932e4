#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gpu/shader_source.hpp"
#include "reference/text/findings.hpp"

namespace lockstep {

/// A run of one compute shader's text, on numbers that are made up.
struct Examination {
    std::filesystem::path file;
    std::array<std::uint32_t, 3> groups{4, 1, 1};
    ShaderDefines defines = {};
    std::map<std::string, std::vector<double>> uniforms = {};
    /// Elements of the array at a block's end, by the block's name; texels along each axis of an image.
    std::map<std::string, std::vector<std::uint32_t>> sizes = {};
    std::uint32_t seed = 1;
};

/// A finding with its places as FILE:LINE.
struct NamedFinding {
    text::Finding found;
    std::string where, other; ///< other: of races
};

struct ExaminationResult {
    std::uint32_t group_size = 1;
    std::vector<std::string> not_given; ///< uniforms, which are 0
    std::vector<NamedFinding> findings;

    [[nodiscard]] std::string text(const Examination& of) const;
    [[nodiscard]] nlohmann::json json(const Examination& of) const;
};

/// Throws Error naming what is not interpreted, or a name that the shader does not have.
ExaminationResult examine(const Examination& of);

} // namespace lockstep
