#pragma once

#include <cstdint>
#include <cstdio>

#include <fmt/format.h>

#include "crosscheck/report/progress.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {

/// Prints "FRAME HASH" of the last frame, or of `every` one, each as soon as it is known. `hash_of(frame, shown)` runs
/// the frame and returns the state's hash after it, which counts where it is shown.
template <class Hash> void print_hash_lines(int frames, bool every, const Hash& hash_of) {
    Progress progress("hash", frames, true);
    for (int frame = 0; frame < frames; ++frame) {
        const bool shown = every || frame + 1 == frames;
        const std::uint64_t hash = hash_of(frame, shown);
        progress.show(frame + 1);
        if (!shown)
            continue;
        fmt::print("{} {}\n", frame, hash_text(hash));
        std::fflush(stdout);
    }
}

} // namespace lockstep
