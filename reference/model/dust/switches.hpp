#pragma once
#include <string_view>
#include <vector>

namespace lockstep::dust {

// What the source leaves open, says twice, or changes from one version to the next. Values in the order of their names.
enum class Random { sin, sin_portable, integer };
enum class Populate { plane, uv, line };
enum class KernelOrder { update_first, tools_first };
enum class Suction { lerp, step, cone_step, force_in_update, force_kernel };
enum class DeathRange { unset, set };
enum class BlowFalloff { distance, square };
enum class ImpulseDt { frame, constant, constant_but_wind };
enum class EmitSpeed { direct, force };
enum class World { none, floor_clamp, floor_radius, floor_bounce, box };
enum class WorldOrder { first, last };
enum class SphereTouch { less, less_equal };
enum class BoxKind { aabb, obb };
enum class BoxDetect { rounded, boxed };
enum class PlaneCast { ratio, normalized };
enum class Drag { free, by_mass };
enum class LastCollider { zeros, none };
enum class OffOn { off, on };
enum class Unit { glsl, engine };
enum class SideExit { kill, keep };
enum class Mesh { cube, quad };
enum class DrawBounds { box, off };
enum class Modulo { fmod, div_frac };
enum class GravityDir { down, vector };
enum class Walls { first, all };
enum class Inside { answer, push_out };
enum class EmitSeed { index, index_time };
enum class Forecast { own, moved };
enum class SphereData { vec4, matrix };
enum class ColourFormat { rgb32f, rgb16f };
enum class ClampVelocity { off, zero };
enum class Root { off, clamp };
enum class EmitDisc { off, even };
enum class DragStep { off, implicit };
// What GL forbids to read literally has one value.
enum class TailGuard { first };
enum class VelocityStart { zero };
enum class EmitAxis { z };

/// The preset `corrected`.
struct Switches {
    Random random = Random::sin_portable;
    Populate populate = Populate::line;
    KernelOrder kernel_order = KernelOrder::tools_first;
    Suction suction = Suction::force_kernel;
    DeathRange death_range = DeathRange::set;
    BlowFalloff blow_falloff = BlowFalloff::distance;
    ImpulseDt impulse_dt = ImpulseDt::constant_but_wind;
    EmitSpeed emit_speed = EmitSpeed::force;
    World world = World::box;
    WorldOrder world_order = WorldOrder::last;
    OffOn one_hit = OffOn::on;
    SphereTouch sphere_touch = SphereTouch::less_equal;
    BoxKind box_kind = BoxKind::obb;
    BoxDetect box_detect = BoxDetect::boxed;
    PlaneCast plane_cast = PlaneCast::ratio;
    Drag drag = Drag::free;
    LastCollider last_collider = LastCollider::none;
    float radius_of_scale = 0.5F;
    Modulo modulo = Modulo::fmod; ///< of a grain's place in its row: x - y floor(x / y), or y frac(x / y)
    GravityDir gravity_dir = GravityDir::vector; ///< down: its y alone
    DrawBounds draw_bounds = DrawBounds::off;    ///< nothing is drawn where the camera misses a box around the origin
    Mesh mesh = Mesh::quad;
    Unit unit = Unit::glsl;            ///< of suction by steps: `engine` is 0 below a length of 1e-5, and divides
    Forecast forecast = Forecast::own; ///< moved: who was pulled is tested again where Update moved it
    SphereData sphere_data = SphereData::matrix;        ///< vec4: centre and radius
    ColourFormat colour_format = ColourFormat::rgb32f;  ///< rgb16f: rounded as half floats are stored
    TailGuard tail_guard = TailGuard::first;            ///< an invocation without a grain returns at once
    VelocityStart velocity_start = VelocityStart::zero; ///< of what nobody writes
    EmitAxis emit_axis = EmitAxis::z;                   ///< the disc that is emitted through lies at z = 1

    // Remedies, off in every preset.
    /// zero: where a wall stops a grain, its velocity out of the world becomes 0
    ClampVelocity clamp_velocity = ClampVelocity::off;
    OffOn sweep = OffOn::off; ///< a movement that passes through a collider hits it, not one alone that ends there
    Root root = Root::off;    ///< clamp: no root of a negative number where a ray grazes a sphere
    SideExit side_exit = SideExit::kill;
    Walls walls = Walls::first;           ///< all: the six limits one after another
    Inside inside = Inside::answer;       ///< push_out: what starts a frame in a sphere goes to its nearest surface
    OffOn safe_direction = OffOn::off;    ///< the direction of nothing is 0, and pulls nothing
    EmitSeed emit_seed = EmitSeed::index; ///< index_time: a grain leaves in another direction each time
    EmitDisc emit_disc = EmitDisc::off;   ///< even: the emitter's disc is filled evenly
    DragStep drag_step = DragStep::off;   ///< implicit: v / (1 + c dt)

    bool operator==(const Switches&) const = default;
};

/// Calls `visit(name, value, {names of the values})` for every switch of named values.
template <class S, class Visit> void for_each_switch(S& s, const Visit& visit) {
    using Names = std::vector<std::string_view>;
    const Names off_on{"off", "on"};
    visit("random", s.random, Names{"sin", "sin_portable", "integer"});
    visit("populate", s.populate, Names{"plane", "uv", "line"});
    visit("kernel_order", s.kernel_order, Names{"update_first", "tools_first"});
    visit("suction", s.suction, Names{"lerp", "step", "cone_step", "force_in_update", "force_kernel"});
    visit("death_range", s.death_range, Names{"unset", "set"});
    visit("blow_falloff", s.blow_falloff, Names{"distance", "square"});
    visit("impulse_dt", s.impulse_dt, Names{"frame", "constant", "constant_but_wind"});
    visit("emit_speed", s.emit_speed, Names{"direct", "force"});
    visit("world", s.world, Names{"none", "floor_clamp", "floor_radius", "floor_bounce", "box"});
    visit("world_order", s.world_order, Names{"first", "last"});
    visit("one_hit", s.one_hit, off_on);
    visit("sphere_touch", s.sphere_touch, Names{"less", "less_equal"});
    visit("box_kind", s.box_kind, Names{"aabb", "obb"});
    visit("box_detect", s.box_detect, Names{"rounded", "boxed"});
    visit("plane_cast", s.plane_cast, Names{"ratio", "normalized"});
    visit("drag", s.drag, Names{"free", "by_mass"});
    visit("last_collider", s.last_collider, Names{"zeros", "none"});
    visit("modulo", s.modulo, Names{"fmod", "div_frac"});
    visit("gravity_dir", s.gravity_dir, Names{"down", "vector"});
    visit("draw_bounds", s.draw_bounds, Names{"box", "off"});
    visit("mesh", s.mesh, Names{"cube", "quad"});
    visit("unit", s.unit, Names{"glsl", "engine"});
    visit("forecast", s.forecast, Names{"own", "moved"});
    visit("sphere_data", s.sphere_data, Names{"vec4", "matrix"});
    visit("colour_format", s.colour_format, Names{"rgb32f", "rgb16f"});
    visit("tail_guard", s.tail_guard, Names{"first"});
    visit("velocity_start", s.velocity_start, Names{"zero"});
    visit("emit_axis", s.emit_axis, Names{"z"});
    visit("clamp_velocity", s.clamp_velocity, Names{"off", "zero"});
    visit("sweep", s.sweep, off_on);
    visit("root", s.root, Names{"off", "clamp"});
    visit("side_exit", s.side_exit, Names{"kill", "keep"});
    visit("walls", s.walls, Names{"first", "all"});
    visit("inside", s.inside, Names{"answer", "push_out"});
    visit("safe_direction", s.safe_direction, off_on);
    visit("emit_seed", s.emit_seed, Names{"index", "index_time"});
    visit("emit_disc", s.emit_disc, Names{"off", "even"});
    visit("drag_step", s.drag_step, Names{"off", "implicit"});
}

/// paper, corrected or exact. Throws Error naming them for any other name.
Switches preset(std::string_view name);

/// What a version of the source had: s1, s2_lerp, s2_step, s2_gpu, s3 to s17, sRE and sTS, on top of `switches`. Throws
/// Error naming them for any other name.
Switches stage(std::string_view name, Switches switches);

} // namespace lockstep::dust
