#include "reference/model/dust/switches.hpp"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/model/error.hpp"

namespace lockstep::dust {
namespace {

/// The versions in the order in which the source comes to them.
constexpr std::array<std::string_view, 20> stages{"s1",  "s2_lerp", "s2_step", "s2_gpu", "s3",  "s4",  "s5",
                                                  "s6",  "s7",      "s8",      "s9",     "s10", "sRE", "s11",
                                                  "s12", "s13",     "s14",     "s15",    "s16", "s17"};

} // namespace

Switches preset(std::string_view name) {
    Switches s;
    if (name == "corrected")
        return s;
    if (name == "exact") {
        s.random = Random::integer;
        return s;
    }
    if (name != "paper")
        throw Error(fmt::format("there is no preset '{}'; there are paper, corrected, exact", name));
    s.random = Random::sin;
    s.kernel_order = KernelOrder::update_first;
    s.death_range = DeathRange::unset;
    s.impulse_dt = ImpulseDt::constant;
    s.sphere_touch = SphereTouch::less;
    s.last_collider = LastCollider::zeros;
    s.draw_bounds = DrawBounds::box;
    s.radius_of_scale = 1.0F;
    return s;
}

Switches stage(std::string_view name, Switches s) {
    std::size_t at = 0;
    while (at < stages.size() && stages[at] != name)
        ++at;
    if (name == "sTS") // the last kernels, with the clock of its own
        return s;
    if (at == stages.size())
        throw Error(fmt::format("there is no stage '{}'; there are {}, sTS", name, fmt::join(stages, ", ")));
    const auto before = [&](std::string_view later) {
        std::size_t there = 0;
        while (stages[there] != later)
            ++there;
        return at < there;
    };
    if (name == "s1" || name == "s2_lerp" || name == "s2_step" || name == "s2_gpu")
        s.populate = Populate::plane;
    else if (before("s12"))
        s.populate = Populate::uv;
    if (before("s3"))
        s.suction = name == "s2_lerp" ? Suction::lerp : Suction::step;
    else if (name == "s3")
        s.suction = Suction::step;
    else if (name == "s4")
        s.suction = Suction::cone_step;
    else if (before("s10"))
        s.suction = Suction::force_in_update;
    if (name == "s1" || name == "s2_lerp" || name == "s2_step")
        s.unit = Unit::engine;
    if (before("s5"))
        s.world = World::none;
    else if (before("s7"))
        s.world = World::floor_clamp;
    else if (before("s9"))
        s.world = World::floor_radius;
    else if (before("s10"))
        s.world = World::floor_bounce;
    if (before("s6"))
        s.mesh = Mesh::cube;
    if (before("sRE")) {
        s.gravity_dir = GravityDir::down;
        s.kernel_order = KernelOrder::update_first;
        s.emit_speed = EmitSpeed::direct;
    }
    if (before("s17"))
        s.impulse_dt = ImpulseDt::frame;
    if (name == "s13")
        s.world_order = WorldOrder::first;
    if (before("s16"))
        s.one_hit = OffOn::off;
    if (before("s17")) {
        s.sphere_data = SphereData::vec4;
        s.box_kind = BoxKind::aabb;
        s.box_detect = BoxDetect::rounded;
    }
    return s;
}

} // namespace lockstep::dust
