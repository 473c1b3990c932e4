#include "reference/model/lifecycle/switches.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::lifecycle {

Switches preset(std::string_view name) {
    Switches s;
    if (name == "corrected" || name == "exact")
        return s;
    if (name != "paper")
        throw Error(fmt::format("there is no preset '{}'; there are paper, corrected, exact", name));
    s.compaction = Compaction::atomic;
    s.may_die = MayDie::nominal;
    s.half_rounding = HalfRounding::toward_zero;
    s.time_code = TimeCode::half_seconds;
    s.emit_when = EmitWhen::before_destroy;
    s.expired = Expired::drawn;
    s.drag = Drag::explicit_force;
    s.distance_sum = DistanceSum::float_blocks;
    s.uv_anchor = UvAnchor::oldest;
    s.ribbon_joint = RibbonJoint::average;
    s.hull_points = HullOf::centres;
    s.uv_outside = UvOutside::clamp;
    return s;
}

} // namespace lockstep::lifecycle
