#pragma once
#include "reference/known_operations.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"
#include "reference/subnormals.hpp"

namespace lockstep {

/// The stage that makes the listing's step, and finds the texel of a point where the pass does so itself: the vertex
/// stage, or with step = compute the compute stage.

/// Subnormals as that stage has them while this lives; kept where they are not `known`.
inline FlushSubnormals flush_in_step(const Switches& switches, const Profile& profile, bool known = true) {
    if (switches.step == Step::transform_feedback)
        return FlushSubnormals(known && profile.flush_subnormals);
    return {known && profile.compute_flush_subnormals,
            known && profile.compute_flush_results.value_or(profile.compute_flush_subnormals)};
}

/// The same frame as the passes see it that draw in vertex and fragment stages whatever `step` is: the obstacles'.
inline FrameParams drawn_by_rasteriser(FrameParams params) {
    params.switches.step = Step::transform_feedback;
    return params;
}

/// What of `known` holds there.
inline KnownOperations known_in_step(const Switches& switches, const KnownOperations& known, const Profile& profile) {
    return switches.step == Step::compute ? in_compute_stage(known, profile) : known;
}

} // namespace lockstep
