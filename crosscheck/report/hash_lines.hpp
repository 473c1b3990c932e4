#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/report/progress.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {

/// The frames of a run whose hashes are shown: the last, or every one from `first` on.
struct HashedFrames {
    int first = 0, end = 60;
    bool every = false;
    std::vector<std::string> lead_in = {}; ///< the passes that run before `first`; empty: all
};

/// Prints "FRAME HASH" of each of these frames as soon as it is known. `hash_of(frame, shown)` runs the frame and
/// returns the state's hash after it, which counts where it is shown.
template <class Hash> void print_hash_lines(const HashedFrames& frames, const Hash& hash_of) {
    Progress progress("hash", frames.end, true);
    for (int frame = 0; frame < frames.end; ++frame) {
        const bool shown = frame >= frames.first && (frames.every || frame + 1 == frames.end);
        const std::uint64_t hash = hash_of(frame, shown);
        progress.show(frame + 1);
        if (!shown)
            continue;
        fmt::print("{} {}\n", frame, hash_text(hash));
        std::fflush(stdout);
    }
}

} // namespace lockstep
