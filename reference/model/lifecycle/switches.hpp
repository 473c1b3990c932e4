#pragma once
#include <string_view>
#include <vector>

namespace lockstep::lifecycle {

// What the source leaves open or measures in several forms. Values in the order of their names.
enum class Management { index_lists, move_alives };
enum class Compaction { atomic, scan };
enum class MayDie { nominal, exact, all };
enum class Fuse { split, fused };
enum class Layout { bytes_112, bytes_80, bytes_72, bytes_64, bytes_48, bytes_44, bytes_40 };
enum class HalfRounding { toward_zero, nearest_even, dithered };
enum class TimeCode { half_seconds, ticks16 };
enum class PositionCode { half, box16 };
enum class ColorCode { rgba8, rgb10_a2 };
enum class EmitWhen { before_destroy, after_simulation };
enum class Overflow { drop_new, replace_oldest };
enum class SpawnSpread { point, path };
enum class Expired { drawn, hidden };
enum class Integration { semi_implicit, explicit_euler, ballistic };
enum class Drag { explicit_force, implicit, exponential };
enum class CurlUse { force, velocity };
enum class CurlDerivative { analytic, difference };
enum class DistanceSum { float_blocks, fixed };
enum class StretchedDivisor { last_index, count };
enum class UvAnchor { oldest, fixed };
enum class RibbonJoint { average, mitre };
/// Which points of a sprite's texels its polygon holds; by_filter: what the filter can touch of them.
enum class HullOf { centres, corners, bilinear, by_filter };
enum class UvOutside { clamp, transparent };

/// The preset `corrected`.
struct Switches {
    Management management = Management::move_alives;
    Compaction compaction = Compaction::scan;
    MayDie may_die = MayDie::exact;
    Fuse fuse = Fuse::fused;
    Layout layout = Layout::bytes_40;
    HalfRounding half_rounding = HalfRounding::nearest_even;
    TimeCode time_code = TimeCode::ticks16;
    PositionCode position_code = PositionCode::half;
    ColorCode color_code = ColorCode::rgba8;
    EmitWhen emit_when = EmitWhen::after_simulation;
    Overflow overflow = Overflow::drop_new;
    SpawnSpread spawn_spread = SpawnSpread::point;
    Expired expired = Expired::hidden;
    Integration integration = Integration::semi_implicit;
    Drag drag = Drag::implicit;
    CurlUse curl_use = CurlUse::force;
    CurlDerivative curl_derivative = CurlDerivative::analytic;
    DistanceSum distance_sum = DistanceSum::fixed;
    StretchedDivisor stretched_divisor = StretchedDivisor::last_index;
    UvAnchor uv_anchor = UvAnchor::fixed;
    RibbonJoint ribbon_joint = RibbonJoint::mitre;
    HullOf hull_points = HullOf::by_filter;
    UvOutside uv_outside = UvOutside::transparent;

    bool operator==(const Switches&) const = default;
};

/// Calls `visit(name, value, {names of the values})` for every switch.
template <class S, class Visit> void for_each_switch(S& s, const Visit& visit) {
    using Names = std::vector<std::string_view>;
    visit("management", s.management, Names{"index_lists", "move_alives"});
    visit("compaction", s.compaction, Names{"atomic", "scan"});
    visit("may_die", s.may_die, Names{"nominal", "exact", "all"});
    visit("fuse", s.fuse, Names{"split", "fused"});
    visit("layout", s.layout, Names{"112", "80", "72", "64", "48", "44", "40"});
    visit("half_rounding", s.half_rounding, Names{"toward_zero", "nearest_even", "dithered"});
    visit("time_code", s.time_code, Names{"half_seconds", "ticks16"});
    visit("position_code", s.position_code, Names{"half", "box16"});
    visit("color_code", s.color_code, Names{"rgba8", "rgb10_a2"});
    visit("emit_when", s.emit_when, Names{"before_destroy", "after_simulation"});
    visit("overflow", s.overflow, Names{"drop_new", "replace_oldest"});
    visit("spawn_spread", s.spawn_spread, Names{"point", "path"});
    visit("expired", s.expired, Names{"drawn", "hidden"});
    visit("integration", s.integration, Names{"semi_implicit", "explicit", "ballistic"});
    visit("drag", s.drag, Names{"explicit", "implicit", "exponential"});
    visit("curl_use", s.curl_use, Names{"force", "velocity"});
    visit("curl_derivative", s.curl_derivative, Names{"analytic", "difference"});
    visit("distance_sum", s.distance_sum, Names{"float_blocks", "fixed"});
    visit("stretched_divisor", s.stretched_divisor, Names{"last_index", "count"});
    visit("uv_anchor", s.uv_anchor, Names{"oldest", "fixed"});
    visit("ribbon_joint", s.ribbon_joint, Names{"average", "mitre"});
    visit("hull_points", s.hull_points, Names{"centres", "corners", "bilinear", "by_filter"});
    visit("uv_outside", s.uv_outside, Names{"clamp", "transparent"});
}

/// paper, corrected or exact. Throws Error naming them for any other name.
Switches preset(std::string_view name);

} // namespace lockstep::lifecycle
