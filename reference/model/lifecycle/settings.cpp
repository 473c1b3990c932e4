#include "reference/model/lifecycle/settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/model/error.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr double most_a_frame = 16'777'216.0; // 2^24

[[noreturn]] void fail(std::size_t emitter, const std::string& what) {
    throw Error(fmt::format("emitter {}: {}", emitter, what));
}

bool has_direction(const glm::vec3& v) { return std::isfinite(glm::length(v)) && glm::length(v) > 0.0F; }

void check(const Force& force, std::size_t emitter, std::size_t at) {
    const auto wrong = [&](const std::string& what) { fail(emitter, fmt::format("force {}: {}", at, what)); };
    if (force.kind == Force::Kind::vortex && !has_direction(force.axis))
        wrong("axis has no length");
    if (force.falloff < 0 || force.falloff > 2)
        wrong(fmt::format("falloff is {}; right is 0, 1 or 2", force.falloff));
    if (!(force.radius > 0.0F))
        wrong(fmt::format("radius is {}; right is above 0", force.radius));
    if (force.seed >= 1U << 24U)
        wrong(fmt::format("seed is {}; right is below 16777216", force.seed));
    if (!(force.kill_radius >= 0.0F))
        wrong(fmt::format("kill_radius is {}; right is 0 or above", force.kill_radius));
    if (force.kind == Force::Kind::drag && !(force.k >= 0.0F))
        wrong(fmt::format("k is {}; right is 0 or above", force.k));
}

void check(const Emitter& e, const Settings& settings, std::size_t at) {
    if (e.capacity < 1 || e.capacity > most_particles_of_emitter)
        fail(at, fmt::format("capacity is {}; right is 1 to {}", e.capacity, most_particles_of_emitter));
    if (!(e.rate >= 0.0 && e.rate * double{settings.tick} < most_a_frame))
        fail(at, fmt::format("rate is {}; right is from 0 to 2^24 particles a tick", static_cast<float>(e.rate)));
    for (const auto& [frame, count] : e.bursts)
        if (frame < 0 || count > 1U << 24U)
            fail(at, fmt::format("burst of {} in frame {}; right is at most 2^24, from frame 0 on", count, frame));
    if (!(std::isfinite(e.lifetime[0]) && std::isfinite(e.lifetime[1]) && e.lifetime[0] <= e.lifetime[1]))
        fail(at, fmt::format("lifetime is {} to {}; right is two finite numbers, the smaller first", e.lifetime[0],
                             e.lifetime[1]));
    if (!has_direction(e.direction))
        fail(at, "direction has no length");
    if (e.cone > 180.0F)
        fail(at, fmt::format("cone is {} degrees; right is at most 180", e.cone));
    for (std::size_t k = 0; k < e.path.size(); ++k)
        if (k > 0 && e.path[k].frame <= e.path[k - 1].frame)
            fail(at,
                 fmt::format("path {}: frame {} after {}; right is rising", k, e.path[k].frame, e.path[k - 1].frame));
    for (std::size_t k = 0; k < e.forces.size(); ++k)
        check(e.forces[k], at, k);
}

} // namespace

namespace {

/// A vertex stage has 16 attributes; where ribbons are drawn from 112 bytes, one is free for what graphs read besides.
void check_attributes(const Settings& settings) {
    bool ribbons = false;
    std::string read;
    std::size_t count = 0;
    for (const char* const input : {"velocity", "acceleration", "spawn_time"})
        if (std::any_of(settings.emitters.begin(), settings.emitters.end(),
                        [&](const Emitter& e) { return e.rendering && reads_input(*e.rendering, input); })) {
            read += (count++ == 0 ? "" : ", ") + std::string(input);
        }
    for (const Emitter& e : settings.emitters)
        ribbons = ribbons || e.draw == Emitter::Draw::ribbon;
    if (settings.switches.layout == Layout::bytes_112 && ribbons && count > 1)
        throw Error(fmt::format("graphs/rendering: {} are more than 16 attributes with ribbons in 112 bytes; right is "
                                "one of them, or another layout",
                                read));
}

void check(const Sprite& sprite) {
    const int side = sprite.texture.width;
    if (side != sprite.texture.height || side > largest_texture)
        throw Error(fmt::format("sprite/texture: {} x {} texels; right is a square of at most {}", side,
                                sprite.texture.height, largest_texture));
    if (sprite.polygon != 0 && side == 0)
        throw Error(
            "sprite/bounding: a polygon is fitted to a texture, and there is none; right is a texture, or quad");
    if (sprite.polygon != 0 && (sprite.polygon < 3 || sprite.polygon > 8))
        throw Error(fmt::format("sprite/bounding: k is {}; right is 3 to 8", sprite.polygon));
    if (sprite.alpha_cut < 0 || sprite.alpha_cut > 254)
        throw Error(fmt::format("sprite/alpha_cut: {}; right is 0 to 254", sprite.alpha_cut));
}

} // namespace

void check(const Settings& settings) {
    if (!(std::isfinite(settings.tick) && settings.tick > 0.0F))
        throw Error(fmt::format("tick is {} s; right is above 0", settings.tick));
    if (settings.emitters.empty())
        throw Error("there is no emitter");
    check_attributes(settings);
    check(settings.sprite);
    const Switches& s = settings.switches;
    if (s.management == Management::index_lists && s.overflow == Overflow::replace_oldest)
        throw Error("overflow=replace_oldest needs the order of birth; right is drop_new, or management=move_alives");
    if (s.position_code == PositionCode::box16)
        for (int axis = 0; axis < 3; ++axis)
            if (!(settings.box_size[axis] > 0.0F))
                throw Error(
                    fmt::format("box: {} units wide in {}; right is above 0", settings.box_size[axis], "xyz"[axis]));
    if (s.uv_anchor == UvAnchor::fixed && s.distance_sum == DistanceSum::float_blocks)
        throw Error("uv_anchor=fixed needs sums without rounding; right is distance_sum=fixed, or uv_anchor=oldest");
    for (std::size_t e = 0; e < settings.emitters.size(); ++e) {
        check(settings.emitters[e], settings, e);
        const Emitter& one = settings.emitters[e];
        if (one.draw == Emitter::Draw::ribbon && s.management == Management::index_lists) {
            if (s.layout != Layout::bytes_112)
                fail(e, "a ribbon of management=index_lists is sorted by its times of birth, which packed layouts do "
                        "not keep; right is layout=112, or management=move_alives");
            if (s.uv_anchor == UvAnchor::fixed)
                fail(e, "uv_anchor=fixed needs the order of birth before death; right is uv_anchor=oldest, or "
                        "management=move_alives");
        }
        if (one.draw == Emitter::Draw::ribbon && one.rendering && output_named(*one.rendering, "size"))
            fail(e, "graphs/rendering: size is that of sprites; of a ribbon right is color alone");
        if (one.simulation && s.drag == Drag::exponential && output_named(*one.simulation, "drag"))
            fail(e, "graphs/simulation: drag=exponential is made by the host; right is implicit or explicit");
        if (one.draw == Emitter::Draw::ribbon && s.uv_anchor == UvAnchor::fixed && s.compaction == Compaction::atomic &&
            one.lifetime[0] != one.lifetime[1])
            fail(e, "uv_anchor=fixed needs the order of birth; right is compaction=scan, or one lifetime");
    }
}

} // namespace lockstep::lifecycle
