#include "lockstep/system.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/package/own_texts.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/scene/profiles.hpp"

namespace lockstep {
namespace {

std::string_view stage_name(bool compute) { return compute ? "compute" : "vertex"; }

/// The shaders in the twins' order, each of its twin's buffer and stage. Throws Error where one is not.
std::vector<GlPass> of_twins(std::vector<GlPass> passes, const System& system) {
    const std::string& name = system.schema.system;
    if (passes.size() != system.passes.size())
        throw Error(fmt::format("{}: {} shaders for {} twins; right is a GlPass for each", name, passes.size(),
                                system.passes.size()));
    for (std::size_t p = 0; p < passes.size(); ++p) {
        if (system.passes[p] == nullptr)
            continue; // check() says so
        const GlPass& gl = passes[p];
        const ItemPass& twin = *system.passes[p];
        const bool compute = twin.stage() == PassStage::compute;
        if (gl.name != twin.name())
            throw Error(fmt::format("{}: pass {} is shader '{}', but twin '{}'; right is one name in one order", name,
                                    p, gl.name, twin.name()));
        if (gl.resource != twin.resource())
            throw Error(fmt::format("{}: {}: its GlPass is of buffer {}, its twin of buffer {}", name, gl.name,
                                    gl.resource, twin.resource()));
        if (gl.continues != twin.continues())
            throw Error(fmt::format("{}: {}: its GlPass {} the pass before, its twin {}", name, gl.name,
                                    gl.continues ? "continues" : "does not continue",
                                    twin.continues() ? "does" : "does not"));
        if ((gl.stage == Stage::compute) != compute)
            throw Error(fmt::format("{}: {}: its GlPass is a {} shader, its twin's stage is {}", name, gl.name,
                                    stage_name(gl.stage == Stage::compute), stage_name(compute)));
    }
    return passes;
}

/// `warnings`: what the driver says of its shaders.
GlSystem made(std::vector<ShaderWarning>& warnings, const Schema& schema, std::vector<GlPass> passes,
              const std::string& shaders, ArithmeticSwitch arithmetic) {
    const ShaderWarnings collected(warnings);
    return {schema, std::move(passes), shaders, arithmetic};
}

} // namespace

GlSystemSide::GlSystemSide(const Gl& gl, const System& system, std::vector<GlPass> passes, const std::string& shaders,
                           ArithmeticSwitch arithmetic)
    : gl_(gl), passes_(of_twins(std::move(passes), gl ? system : throw Error(gl.missing()))), shaders_(shaders),
      arithmetic_(arithmetic), system_(made(warnings_, system.schema, passes_, shaders, arithmetic)) {}

SideDescription GlSystemSide::describe() const {
    return {gl_.name(),
            system_.says_precise() ? gl_.profile() : gl_.profile_without_precise(system_.says_precise_once()),
            {},
            {},
            warnings_};
}

MatchResult match_system(SystemSide& gpu, const System& system, const SystemMatchOptions& options) {
    const SideDescription side = gpu.describe();
    System here = beside(system);
    std::optional<SystemTexts> texts;
    if (const auto* gl = dynamic_cast<const GlSystemSide*>(&gpu)) {
        texts.emplace(here, gl->passes(), gl->arithmetic());
        texts->take_shaders(gl->shaders(), options.reference.empty() ? gl->shaders() : options.reference);
    }
    CheckOptions check_options;
    check_options.mode = options.mode;
    check_options.frames = options.frames;
    check_options.known = known_operations(options.legal, side.profile);
    CheckReport report = check(here, gpu, check_options);
    note_unset_variables(report, side.warnings);
    RunDescription run =
        describe_run(system, side, check_options, options.repeat.empty() ? this_program({}) : options.repeat);
    if (texts)
        add_notes(run, texts->notes(gpu, *check_options.known, report));
    ask_power(report, options.power_at_least);
    const bool passed = passes(report, {options.allow_undefined, false, options.power_at_least});
    return {std::move(report), std::move(run), passed};
}

} // namespace lockstep
