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
#include "tests/system_run.hpp"

namespace lockstep::test {

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
    return run_system(lifecycle::system(host), lifecycle::passes(host), shaders, settings.arithmetic, frames, mode);
}

/// The reference alone.
inline ReferenceRun reference_of(const System& system) { return {system, named_profile("strict")}; }

} // namespace lockstep::test
