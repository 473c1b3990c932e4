#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/text/memory.hpp"
#include "reference/text/trace.hpp"

namespace lockstep::text {

/// What the invocations of a group find in memory.
struct GroupMemory {
    struct Moment {
        std::vector<std::vector<std::uint32_t>> words; ///< of blocks, then of images
        std::vector<std::uint32_t> shared;
    };
    std::vector<Moment> moments; ///< at its start, behind each barrier that all come to, and at its end
};

/// Runs one group of a dispatch. What `bindings` name stays as it is. Throws Error where its barriers are too many to
/// keep what lies between them.
GroupMemory remembered_group(const Program& program, const std::array<std::uint32_t, 3>& groups,
                             const Bindings& bindings, const Profile& profile, std::uint32_t group);

/// A word that a stretch of a group between two barriers writes, once: as the stretch leaves it, and by whom last.
struct GroupWrite {
    WrittenPlace place;
    std::uint32_t word = 0, invocation = 0;
};
/// What the stretches of one group of a dispatch write. What `bindings` name stays as it is.
std::vector<std::vector<GroupWrite>> group_writes(const Program& program, const std::array<std::uint32_t, 3>& groups,
                                                  const Bindings& bindings, const Profile& profile,
                                                  std::uint32_t group);

/// run_traced of one of the group's invocations, from its start to the end of the stretch that begins at
/// moments[stretch]. Returns what it wrote in that stretch, shared words too; without a stretch it runs to its end, and
/// shared words are left out. What the others do behind a barrier is as they did it, whatever is forced; an atomic
/// operation finds what lay there at the stretch's start.
std::vector<TracedWord> run_traced_in_group(const Program& program, const Invocation& invocation,
                                            std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                            const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                            GroupMemory& group, std::optional<std::size_t> stretch);

} // namespace lockstep::text
