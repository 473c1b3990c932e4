#include "crosscheck/collision/record/trace_info.hpp"

namespace lockstep {

Profile followed_profile(const TraceInfo& info) { return info.profile.value_or(Profile{}); }

KnownOperations known_operations(const TraceInfo& info, Legal legal) {
    return info.profile ? known_operations(legal, *info.profile) : KnownOperations{.sums = legal != Legal::any_order};
}

std::vector<std::string> notes_on(const TraceInfo& info) {
    std::vector<std::string> notes = info.warnings;
    if (!info.has_cdt)
        notes.emplace_back("no CDT was recorded: particles alone are compared, and the reference draws the CDT of the "
                           "recorded ones; where the GPU drew another texel, a particle that reads it may differ");
    if (!info.counts.empty())
        notes.emplace_back("not every particle is there in every frame: those that are not are NaN");
    if (!info.profile)
        notes.emplace_back("the driver was not measured: the reference is strict, and what differs is judged by "
                           "GLSL's rules alone");
    return notes;
}

} // namespace lockstep
