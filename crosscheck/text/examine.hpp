#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/text/examination.hpp"
#include "crosscheck/text/gpu_comparison.hpp"
#include "crosscheck/text/named_finding.hpp"
#include "crosscheck/text/text_comparison.hpp"
#include "crosscheck/text/text_coverage.hpp"

namespace lockstep {

struct ExaminationResult {
    std::string ran;                    ///< "4 groups of 64 invocations", "64 vertices"
    std::uint32_t group_size = 0;       ///< of a compute stage
    std::vector<std::string> not_given; ///< uniforms, which are 0
    std::vector<NamedFinding> findings;
    TextCoverage coverage; ///< without lines of a module, which has no text
    std::optional<GpuComparison> gpu;
    std::optional<TextComparison> reference;

    /// Nothing was found, and nothing differs but as the texts allow.
    [[nodiscard]] bool is_right() const {
        return findings.empty() && (!gpu || gpu->is_right()) && (!reference || reference->is_right());
    }
    [[nodiscard]] std::string text(const Examination& of) const;
    [[nodiscard]] nlohmann::json json(const Examination& of) const;
};

/// `gl`: has a compute stage run there, too; null: no GL is needed. Throws Error naming what is not interpreted, a name
/// that the shader does not have, or what the reference has otherwise.
ExaminationResult examine(const Examination& of, const MeasuredGl* gl = nullptr);

} // namespace lockstep
