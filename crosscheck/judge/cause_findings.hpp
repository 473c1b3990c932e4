#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// One mistake, or up to three at once, and what it explains: where the reference that makes it has the GPU's bits. On
/// a driver whose division or roots were measured to err, all fields as near as a few of these errors allow.
struct Cause {
    std::vector<std::string> mistakes; ///< their names
    std::string meaning;               ///< in words
    std::uint64_t explained = 0;       ///< divergent items
    std::uint64_t contradicted = 0;    ///< ones that agree, and would not
    bool has_name = true;              ///< else a change at a site of the twin, in the engine's words

    [[nodiscard]] std::string name() const; ///< "a", "a + b"
};

/// The causes that explain most of what diverged, and with nothing contradicted; equals stand side by side. Empty where
/// no mistake explains anything.
struct CauseFindings {
    std::uint64_t divergent = 0; ///< tried on
    std::vector<Cause> best;

    [[nodiscard]] bool explains_all() const {
        return !best.empty() && best.front().explained == divergent && best.front().contradicted == 0;
    }
};

} // namespace lockstep
