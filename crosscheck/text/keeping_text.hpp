#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reference/text/program.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// Words that are kept of an invocation of a vertex, geometry or fragment stage: whether it ended, vertices that were
/// emitted and after which of them a strip ended (a bit each), inputs, outputs of each vertex.
struct InvocationRecord {
    std::vector<const text::StageVariable*> inputs;
    std::vector<std::pair<const text::StageVariable*, std::uint32_t>> outputs; ///< with the component
    std::uint32_t vertices = 1;                                                ///< at most
    bool is_geometry = false;

    explicit InvocationRecord(const text::Program& stage);
    static constexpr std::uint32_t first_input = 3;
    [[nodiscard]] std::uint32_t first_output() const;
    [[nodiscard]] std::uint32_t words() const;
};

/// A stage's text that keeps what its invocations have and make in the storage block LsRecords: how many there were,
/// and the records of the first `most`.
std::string keeping_text(const InvocationRecord& record, std::string text, std::size_t most);

/// The inputs of the invocations whose records these are, one after the other.
text::StageRun run_of(const InvocationRecord& record, std::span<const std::uint32_t> records);
/// And what the stage made.
text::StageResult result_of(const InvocationRecord& record, std::span<const std::uint32_t> records);

} // namespace lockstep
