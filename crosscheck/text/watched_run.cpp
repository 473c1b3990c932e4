#include "crosscheck/text/watched_run.hpp"

#include <algorithm>
#include <utility>

#include "crosscheck/text/made_up_inputs.hpp"
#include "reference/text/dispatch.hpp"

namespace lockstep {

const Profile& examined_profile() {
    static const Profile profile = named_profile("strict");
    return profile;
}

bool is_endless(const text::Findings& findings) { return std::ranges::any_of(findings.all(), text::is_endless); }

WatchedRun run_watched(const Examination& of, const text::Program& program, MadeUpWorld world,
                       const text::StageRun& stage) {
    const bool runs_again = of.is_watched && program.stage == spv::ExecutionModelGLCompute;
    MadeUpWorld again = runs_again ? world.copy() : MadeUpWorld();
    WatchedRun run{
        .world = std::move(world), .writers = {}, .outputs = {}, .findings = {}, .coverage = text::Coverage(program)};
    if (program.stage != spv::ExecutionModelGLCompute) {
        text::StageRun covered = stage;
        covered.coverage = &run.coverage;
        run.outputs = text::run_stage(program, covered, run.world.bindings, examined_profile(), run.findings);
        return run;
    }
    text::Dispatch dispatch{.groups = of.groups,
                            .is_watched = of.is_watched,
                            .most_branches = most_branches,
                            .subgroup_size = of.subgroup_size,
                            .writers = of.reference.empty() ? nullptr : &run.writers,
                            .coverage = &run.coverage};
    if (!text::run_dispatch(program, dispatch, run.world.bindings, examined_profile(), run.findings) ||
        is_endless(run.findings) || !runs_again)
        return run;
    // Groups that wait for earlier ones find what they wait for, since these run first: run the other way round, they
    // do not.
    text::Findings reversed;
    dispatch.writers = nullptr;
    dispatch.coverage = nullptr;
    dispatch.is_reversed = true;
    text::run_dispatch(program, dispatch, again.bindings, examined_profile(), reversed);
    for (const text::Finding& one : reversed.all())
        if (one.rule == text::waiting_rule)
            run.findings.add(one.rule, one.place, [&] { return one.what; });
    return run;
}

} // namespace lockstep
