#pragma once
#include <string>
#include <utility>
#include <vector>

#include <lockstep/system.hpp>

namespace lockstep::test {

/// The one GL of a test program.
inline const Gl& gl() {
    static const Gl one;
    return one;
}

/// A run of a system on both sides.
inline CheckReport run_system(const System& system, std::vector<GlPass> passes, const std::string& shaders,
                              ArithmeticSwitch arithmetic, int frames, CheckMode mode) {
    GlSystemSide side(gl(), system, std::move(passes), shaders, arithmetic);
    CheckOptions options;
    options.frames = frames;
    options.mode = mode;
    return check(system, side, options);
}

} // namespace lockstep::test
