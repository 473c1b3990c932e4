#pragma once
#include <memory>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "crosscheck/lifecycle/system.hpp"
#include "gpu/lifecycle/passes.hpp"
#include "reference/model/lifecycle/schema.hpp"

namespace lockstep::test {

inline const Gl& gl() {
    static const Gl one;
    return one;
}

inline lifecycle::HostPtr host_of(lifecycle::Settings settings) {
    return std::make_shared<const lifecycle::Host>(std::move(settings));
}

inline lifecycle::Settings in_exact(lifecycle::Settings settings) {
    settings.arithmetic = ArithmeticSwitch::exact;
    return settings;
}

/// A run of settings on both sides.
inline CheckReport run_lifecycle(const lifecycle::Settings& settings, int frames, CheckMode mode = CheckMode::resync,
                                 const std::string& shaders = "shaders/lifecycle") {
    const lifecycle::HostPtr host = host_of(settings);
    const System system = lifecycle::system(host);
    GlSystemSide side(gl(), system, lifecycle::passes(host), shaders, settings.arithmetic);
    CheckOptions options;
    options.frames = frames;
    options.mode = mode;
    return check(system, side, options);
}

/// The reference alone.
inline ReferenceRun reference_of(const System& system) { return {system, named_profile("strict")}; }

} // namespace lockstep::test
