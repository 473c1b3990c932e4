#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/witness.hpp"

namespace lockstep {

/// Whether the invocations of a group share more than what they read: barriers, shared variables, atomic operations.
bool shares(const text::Program& program);

/// witness_lines of texts whose invocations share: of the groups given, the first that has any, in the first stretch
/// between two barriers in which an invocation writes otherwise. `common`: WitnessedText::common of the reference, but
/// for shared variables, which go by their names; places of `wrong` are common as they are.
std::vector<WitnessLine>
group_witness_lines(const BoundStage& wrong, const BoundStage& reference, std::span<const std::uint32_t> groups,
                    const std::function<std::optional<text::WrittenPlace>(text::WrittenPlace)>& common,
                    const std::function<std::string(std::uint32_t line)>& line_of_wrong,
                    const std::function<std::string(std::uint32_t line)>& line_of_reference);

} // namespace lockstep
