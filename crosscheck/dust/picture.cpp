#include "crosscheck/dust/picture.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "crosscheck/dust/drawing_mistakes.hpp"
#include "gpu/dust/passes.hpp"
#include "reference/dust/draw_pass.hpp"
#include "reference/model/dust/drawing.hpp"
#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {
namespace {

constexpr Rgba8 sky{196, 208, 220, 255}, cone_colour{214, 96, 32, 255}, collider_colour{36, 92, 170, 255},
    world_colour{128, 138, 150, 255};
constexpr int spokes = 24;

using Lines = std::vector<OverlayLine>;

/// A closed line through the points of a circle of one turn.
void add_ring(Lines& lines, const std::function<glm::vec3(double angle)>& at, Rgba8 colour) {
    constexpr int steps = 48;
    for (int i = 0; i < steps; ++i)
        lines.push_back({at(2.0 * std::numbers::pi * i / steps), at(2.0 * std::numbers::pi * (i + 1) / steps), colour});
}

void add_box(Lines& lines, const glm::mat4& to_world, const glm::vec3& low, const glm::vec3& high, Rgba8 colour) {
    const auto corner = [&](int k) {
        const glm::vec3 at((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z);
        return glm::vec3(to_world * glm::vec4(at, 1.0F));
    };
    for (int k = 0; k < 8; ++k)
        for (const int axis : {1, 2, 4})
            if ((k & axis) == 0)
                lines.push_back({corner(k), corner(k | axis), colour});
}

/// The source's gizmo: 24 spokes to a rim, both on the sphere of the tool's range, and two arcs of the cap over them.
void add_cone(Lines& lines, const FrameValues& values) {
    const double range = values.tool->kind == Tool::Kind::emit ? values.tool->distance : values.tool->range;
    const double angle = double{values.angle_rad};
    const auto on_cap = [&](double off_axis, double turn) {
        const glm::dvec3 local(std::cos(turn) * std::sin(off_axis), std::sin(turn) * std::sin(off_axis),
                               std::cos(off_axis));
        return glm::vec3(glm::dmat4(values.controller_matrix) * glm::dvec4(local * range, 1.0));
    };
    for (int i = 0; i < spokes; ++i)
        lines.push_back({values.controller_pos, on_cap(angle, 2.0 * std::numbers::pi * i / spokes), cone_colour});
    for (const double share : {1.0, 2.0 / 3.0, 1.0 / 3.0})
        add_ring(
            lines, [&](double turn) { return on_cap(angle * share, turn); }, cone_colour);
}

Lines lines_of(const Host& host, int frame) {
    Lines lines;
    const Settings& s = host.settings();
    if (host.switches().world == World::box)
        add_box(lines, glm::mat4(1.0F), s.world.min, s.world.max, world_colour);
    for (const ColliderMatrices& sphere : host.spheres())
        for (int axis = 0; axis < 3; ++axis)
            add_ring(
                lines,
                [&](double turn) {
                    glm::vec3 at(0.0F);
                    at[axis] = static_cast<float>(0.5 * std::cos(turn));
                    at[(axis + 1) % 3] = static_cast<float>(0.5 * std::sin(turn));
                    return glm::vec3(sphere.local_to_world * glm::vec4(at, 1.0F));
                },
                collider_colour);
    for (const ColliderMatrices& box : host.boxes())
        add_box(lines, box.local_to_world, glm::vec3(-0.5F), glm::vec3(0.5F), collider_colour);
    if (const FrameValues values = host.at(frame); values.tool != nullptr)
        add_cone(lines, values);
    return lines;
}

} // namespace

SystemPicture picture(const HostPtr& host, const SystemState& state, int frame) {
    GlPicture how;
    const Settings& settings = host->settings();
    const Drawing made = drawing(settings, static_cast<float>(how.width) / static_cast<float>(how.height));
    const Mesh mesh = settings.switches.mesh;
    how.background = sky;
    if (is_drawn(settings, made))
        how.indices.assign(triangles(mesh).begin(), triangles(mesh).end());
    System system{
        .name = "picture",
        .schema = drawn_schema(),
        .passes = {},
        .mistakes = drawing_mistakes(),
        .start = {drawn_schema(), {state.extent(0), state.extent(1), {settings.count * corners(mesh).size()}}},
        .settings = {}};
    system.passes.push_back(draw_pass(host, made));
    system.start.take(grain_buffer, state);
    system.start.take(count_buffer, state);
    const ColorImage background(how.width, how.height, how.background);
    const auto image = [mesh, background, drawn = !how.indices.empty()](const SystemView& corners_of) {
        return drawn ? draw_image(corners_of, mesh, background) : background;
    };
    return {std::move(system),    {draw_gl_pass(host, made)}, std::move(how), image,
            made.view_projection, lines_of(*host, frame)};
}

} // namespace lockstep::dust
