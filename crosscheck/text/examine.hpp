#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/text/fills.hpp"
#include "crosscheck/text/gpu_comparison.hpp"
#include "gpu/shader_source.hpp"
#include "reference/text/findings.hpp"
#include "reference/text/invocation.hpp"

namespace lockstep {

/// A run of one stage's text, on numbers that are made up.
struct Examination {
    std::filesystem::path file = {};
    std::array<std::uint32_t, 3> groups{4, 1, 1}; ///< of a compute stage
    /// Vertices, primitives or fragments of another stage, and their inputs by name, the same for all: numbers as they
    /// are typed, since their type is the text's.
    std::uint32_t invocations = 64;
    std::map<std::string, std::vector<std::string>> inputs = {};
    ShaderDefines defines = {};
    std::map<std::string, std::vector<std::string>> uniforms = {};
    /// Elements of the array at a block's end, by the block's name; texels along each axis of an image.
    std::map<std::string, std::vector<std::uint32_t>> sizes = {};
    Fills fills = {};
    std::uint32_t seed = 1;
    std::uint32_t subgroup_size = text::lanes_at_once; ///< at most so many
};

/// A finding with its places as FILE:LINE.
struct NamedFinding {
    text::Finding found;
    std::string where, other; ///< other: of races
};

struct ExaminationResult {
    std::string ran;                    ///< "4 groups of 64 invocations", "64 vertices"
    std::uint32_t group_size = 0;       ///< of a compute stage
    std::vector<std::string> not_given; ///< uniforms, which are 0
    std::vector<NamedFinding> findings;
    std::optional<GpuComparison> gpu;

    [[nodiscard]] std::string text(const Examination& of) const;
    [[nodiscard]] nlohmann::json json(const Examination& of) const;
};

/// By the extension of its name, in GLSL or SPIR-V; null: it is no stage's.
std::optional<Stage> stage_of(const std::filesystem::path& file);

/// `gl`: has a compute stage run there, too; null: no GL is needed. Throws Error naming what is not interpreted, or a
/// name that the shader does not have.
ExaminationResult examine(const Examination& of, const MeasuredGl* gl = nullptr);

} // namespace lockstep
