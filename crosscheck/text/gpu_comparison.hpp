#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/text/made_up_world.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "crosscheck/text/word_comparison.hpp"
#include "reference/model/profile.hpp"
#include "reference/text/findings.hpp"

namespace lockstep {

/// A GL, whose context is current, and how its driver computes.
struct MeasuredGl {
    std::string name;
    Profile profile;
};

/// A driver's words of a dispatch beside those that the shader's own text allows.
struct GpuComparison {
    std::string gl;
    std::string not_run;       ///< why it was not run; empty: it was
    std::size_t words = 0;     ///< that lie in storage blocks and images
    std::size_t differing = 0; ///< from the text's bits
    std::size_t legal = 0;     ///< of these, as GL allows
    std::size_t open = 0;      ///< left open by what was found in the text
    std::size_t unjudged = 0;  ///< of invocations that are not followed by sets
    std::string unjudged_for;
    std::vector<std::string> wrong; ///< the first few of the rest: where, what the text has, what the driver made
    std::size_t wrong_words = 0;
    std::optional<ComparedWord> first_wrong = {};

    [[nodiscard]] bool is_right() const { return wrong_words == 0 && unjudged == 0; }
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::json json() const;
};

/// Runs a compute stage on GL from the same state as its text, and compares every word of its storage blocks and
/// images. `found`: what a watched run of the text came by, which leaves open what it touches.
GpuComparison compare_with_gpu(const MeasuredGl& gl, const StageText& stage, const std::array<std::uint32_t, 3>& groups,
                               const MadeUpWorld& world, const text::Findings& found);

} // namespace lockstep
