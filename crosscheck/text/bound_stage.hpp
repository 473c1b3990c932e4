#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/text/alignment.hpp"
#include "reference/text/dispatch.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// A stage's text with what it is bound to, whose invocations are run one by one. Refers to what it is made of.
struct BoundStage {
    const text::Program& program;
    const text::Bindings& bindings; ///< as before the run
    const Profile& profile;
    std::array<std::uint32_t, 3> groups{1, 1, 1}; ///< of a compute stage
    const text::StageRun* run = nullptr;          ///< of another, which has its inputs

    [[nodiscard]] text::Invocation invocation(std::uint32_t number) const;
    [[nodiscard]] std::vector<text::GivenInput> inputs(std::uint32_t invocation) const;
    /// Throws Error for what is not run apart from others, as run_traced does.
    [[nodiscard]] text::TracedRun traced(std::uint32_t invocation, std::span<const text::ForcedRow> forced = {}) const;
    /// FILE:LINE of the last statement of an invocation that writes a place; nothing where it is not known.
    [[nodiscard]] std::optional<std::string> line_of(std::uint32_t invocation, const text::WrittenPlace& place) const;
};

/// The line that a step is shown by: its own, or, of a small function that stands in the place of its call and lies in
/// another file, the call's.
struct ShownLine {
    std::uint32_t line = 0;
    bool is_call = false;
};
ShownLine shown_line(const text::Program& program, std::uint32_t step);

/// Traces one invocation, and gives what it writes; one of a group that shares finds what the others left. Throws Error
/// for what is not run so.
std::vector<text::TracedWord> trace_alone(const BoundStage& stage, std::uint32_t invocation, text::Trace& trace);

} // namespace lockstep
