#include "lockstep/system.hpp"

#include <utility>

#include "crosscheck/scene/profiles.hpp"

namespace lockstep {

GlSystemSide::GlSystemSide(const Gl& gl, const System& system, std::vector<GlPass> passes, const std::string& shaders,
                           ArithmeticSwitch arithmetic)
    : gl_(gl), system_((gl ? system : throw Error(gl.missing())).schema, std::move(passes), shaders, arithmetic) {}

SideDescription GlSystemSide::describe() const { return {gl_.name(), gl_.profile(), {}, {}}; }

MatchResult match_system(SystemSide& gpu, const System& system, const MatchOptions& options) {
    const SideDescription side = gpu.describe();
    CheckOptions check_options;
    check_options.mode = options.mode;
    check_options.frames = options.frames;
    check_options.known = known_operations(options.legal, side.profile);
    CheckReport report = check(system, gpu, check_options);
    RunDescription run =
        describe_run(system, side, check_options, options.repeat.empty() ? this_program({}) : options.repeat);
    const bool passed = passes(report, {options.allow_undefined, false});
    return {std::move(report), std::move(run), passed};
}

} // namespace lockstep
