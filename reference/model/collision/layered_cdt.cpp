#include "reference/model/collision/layered_cdt.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void require_corrected(const Switches& switches, std::span<const std::string_view> names, std::string_view who_needs) {
    for (const std::string_view name : names) {
        const std::string value = switch_value(switches, name);
        const std::string needed = switch_value(Switches{}, name);
        if (value != needed)
            throw Error(fmt::format("switch {}: {} {}, not {}", name, who_needs, needed, value));
    }
}

/// A texel of depth is unprojected as it was projected, and holds a float.
void check_depth_search(const Switches& switches) {
    constexpr std::array<std::string_view, 3> corrected{"perspective_divide", "base_texel", "cdt_format"};
    require_corrected(switches, corrected, "search = depth needs");
    if (switches.obstacles_in_cdt == ObstaclesInCdt::vertices)
        throw Error("switch obstacles_in_cdt: search = depth needs triangles or off, not vertices");
}

} // namespace

CdtPlanes cdt_planes(const Switches& switches) {
    return {switches.cdt_layers, switches.cdt_cameras, switches.response == Response::mutual};
}

bool has_remedies(const Switches& switches) {
    return switches.cdt_layers > 1 || switches.cdt_cameras > 1 || switches.search_window != SearchWindow::texels ||
           switches.response != Response::single;
}

bool is_listing(const Switches& switches) { return switches.search == Search::cdt && !has_remedies(switches); }

bool chooses_pass(std::string_view switch_name) {
    return switch_name == "search" || switch_name == "step" ||
           std::find(remedy_switches.begin(), remedy_switches.end(), switch_name) != remedy_switches.end();
}

void check_switches(const Switches& switches) {
    if (switches.step == Step::compute && switches.search != Search::cdt)
        throw Error(fmt::format("switch step: search = {} has a compute pass of its own and needs transform_feedback, "
                                "not compute",
                                switch_value(switches, "search")));
    if (switches.velocity == Velocity::vector && !is_listing(switches))
        throw Error("switch velocity: search = octree, search = depth, cdt_layers, cdt_cameras, search_window and "
                    "response need direction_and_speed, not vector");
    if (switches.not_searching == NotSearching::stands && !is_listing(switches))
        throw Error("switch not_searching: search = octree, search = depth, cdt_layers, cdt_cameras, search_window and "
                    "response need moves, not stands");
    if (switches.search == Search::depth)
        check_depth_search(switches);
    if (!has_remedies(switches))
        return;
    if (switches.step == Step::compute)
        throw Error("switch step: cdt_layers, cdt_cameras, search_window and response need transform_feedback, not "
                    "compute");
    if (switches.search != Search::cdt)
        throw Error(fmt::format("switch search: cdt_layers, cdt_cameras, search_window and response need cdt, not {}",
                                switch_value(switches, "search")));
    constexpr std::array<std::string_view, 6> corrected{"perspective_divide", "base_texel",    "self_position",
                                                        "empty_texel",        "zero_distance", "raster_position"};
    require_corrected(switches, corrected, "cdt_layers, cdt_cameras, search_window and response need");
    if (switches.response == Response::mutual && switches.cdt_format == CdtFormat::rgba8)
        throw Error("switch cdt_format: response = mutual stores velocities and needs rgba32f or rgba16f, not rgba8");
    if (switches.response == Response::mutual && switches.cdt_cameras > 1)
        throw Error("switch cdt_cameras: response = mutual needs 1; what two cameras see would count twice");
}

int cdt_height(const Scene& scene) {
    check_switches(scene.switches);
    return scene.height * (has_remedies(scene.switches) ? cdt_planes(scene.switches).count() : 1);
}

CollisionImage empty_cdt(const Scene& scene) { return {scene.width, cdt_height(scene)}; }

glm::vec3 projected_reach(const glm::mat4& proj_view, const FrameParams& params) {
    const glm::dmat4 m(proj_view);
    const auto row = [&](int r) { return glm::dvec3(m[0][r], m[1][r], m[2][r]); };
    const auto steepest = [&](int r) { return std::max(glm::length(row(r) - row(3)), glm::length(row(r) + row(3))); };
    const glm::dvec3 texels(0.5 * params.width * steepest(0), 0.5 * params.height * steepest(1),
                            glm::length(row(3)) * (1.0 + 0x1p-10));
    return glm::vec3(texels * static_cast<double>(params.constants.collision_range));
}

} // namespace lockstep
