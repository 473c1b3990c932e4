#pragma once
#include <memory>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "crosscheck/dust/system.hpp"
#include "gpu/dust/passes.hpp"
#include "reference/model/dust/schema.hpp"
#include "tests/system_run.hpp"

namespace lockstep::test {

inline dust::HostPtr host_of(dust::Settings settings) {
    return std::make_shared<const dust::Host>(std::move(settings));
}

inline dust::Settings in_exact(dust::Settings settings) {
    settings.arithmetic = ArithmeticSwitch::exact;
    settings.switches.random = dust::Random::integer;
    return settings;
}

/// A run of settings on both sides.
inline CheckReport run_dust(const dust::Settings& settings, int frames, CheckMode mode = CheckMode::resync,
                            const std::string& shaders = "shaders/dust") {
    const dust::HostPtr host = host_of(settings);
    return run_system(dust::system(host), dust::passes(host), shaders, settings.arithmetic, frames, mode);
}

} // namespace lockstep::test
