#include "gpu/collision/collision_shaders.hpp"

#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
namespace {

const std::vector<Stage> points{Stage::vertex, Stage::geometry, Stage::fragment};
const std::vector<Stage> no_geometry{Stage::vertex, Stage::fragment};
const std::vector<Stage> vertex_alone{Stage::vertex};
const std::vector<Stage> compute_alone{Stage::compute};

} // namespace

ShaderFolders collision_shaders(const std::filesystem::path& user) { return shader_folders(user, "collision"); }

ShaderDefines switch_defines(const Switches& switches) {
    ShaderDefines defines;
    for (const SwitchInfo& info : switch_table()) {
        if (info.values.empty())
            continue;
        const ShaderDefines choice =
            choice_defines(info.name, info.values, static_cast<std::size_t>(info.get(switches)));
        defines.insert(defines.end(), choice.begin(), choice.end());
    }
    return defines;
}

std::vector<PassStages> collision_stages(const Scene& scene, bool rendered) {
    const Switches& switches = scene.switches;
    const bool octree = switches.search == Search::octree;
    std::vector<PassStages> passes;
    if (octree)
        passes.push_back({"octree_pass", compute_alone});
    else if (has_remedies(switches))
        passes.insert(passes.end(), {{"layered_collision_pass", vertex_alone}, {"layered_cdt", no_geometry}});
    else
        passes.push_back({"collision_pass", points});
    if (!octree && switches.obstacles_in_cdt != ObstaclesInCdt::off && !scene.obstacles.positions.empty())
        passes.push_back(
            {switches.obstacles_in_cdt == ObstaclesInCdt::triangles ? "obstacle_pass" : "obstacle_vertices", points});
    if (rendered)
        passes.insert(passes.end(),
                      {{"render_background", no_geometry}, {"render_obstacles", points}, {"render_pass", points}});
    return passes;
}

ShaderUse shader_use(const Scene& scene, const std::filesystem::path& user, bool rendered) {
    return shader_use("collision", collision_stages(scene, rendered), user);
}

} // namespace lockstep
