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

/// A text whose invocations share.
struct SharingText {
    const BoundStage& stage;
    const ShaderSource& source;
};

/// witness_lines of texts whose invocations share. Where both share alike, in the first stretch between two barriers in
/// which an invocation writes otherwise, in the first of the groups that has one; else from an invocation's start to
/// its end. `common`: WitnessedText::common of the reference, but for shared variables, which go by their names; places
/// of `wrong` are common as they are.
std::vector<WitnessLine>
group_witness_lines(const SharingText& wrong, const SharingText& reference, std::span<const ItemWriters> items,
                    std::span<const ItemWriters> others,
                    const std::function<std::optional<text::WrittenPlace>(text::WrittenPlace)>& common,
                    const std::function<bool(std::string_view where)>& is_own);

} // namespace lockstep
