#include "gpu/collision/collision_shaders.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "gpu/collision/host_depth.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
namespace {

const std::vector<Stage> points{Stage::vertex, Stage::geometry, Stage::fragment};
const std::vector<Stage> no_geometry{Stage::vertex, Stage::fragment};
const std::vector<Stage> vertex_alone{Stage::vertex};
const std::vector<Stage> compute_alone{Stage::compute};

void add_listing(const Switches& switches, std::vector<PassStages>& passes) {
    if (switches.step == Step::compute)
        passes.insert(passes.end(), {{"clear_nearest", compute_alone},
                                     {"collision_pass", compute_alone},
                                     {"nearest_particle", compute_alone},
                                     {"collision_texels", no_geometry}});
    else
        passes.push_back({"collision_pass", points});
}

/// Of the settings of one switch, the first that has a file run; empty where there is none, or where it runs as it is.
std::string setting_that_runs(const std::string& file, const Switches& switches) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 7> choices{{{"step", "compute"},
                                                                                    {"step", "transform_feedback"},
                                                                                    {"search", "octree"},
                                                                                    {"search", "depth"},
                                                                                    {"cdt_layers", "2"},
                                                                                    {"obstacles_in_cdt", "triangles"},
                                                                                    {"obstacles_in_cdt", "vertices"}}};
    for (const auto& [name, value] : choices) {
        Scene scene;
        scene.switches = switches;
        scene.obstacles.positions.resize(1);
        set_switch(scene.switches, name, value);
        for (const PassStages& pass : collision_stages(scene))
            for (const Stage stage : pass.stages)
                if (file == fmt::format("{}{}", pass.name, extension(stage)) && value != switch_value(switches, name))
                    return fmt::format("{}={}", name, value);
    }
    return {};
}

} // namespace

ShaderFolders collision_shaders(const std::filesystem::path& user) { return shader_folders(user, "collision"); }

ShaderDefines switch_defines(const Switches& switches) {
    ShaderDefines defines;
    for (const SwitchInfo& info : switch_table()) {
        if (info.values.empty() || info.name == "step") // chooses which files run, and is no file's own business
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
    else if (switches.search == Search::depth)
        passes.push_back({"depth_pass", compute_alone});
    else if (has_remedies(switches))
        passes.insert(passes.end(), {{"layered_collision_pass", vertex_alone}, {"layered_cdt", no_geometry}});
    else
        add_listing(switches, passes);
    if (!octree && switches.obstacles_in_cdt != ObstaclesInCdt::off && !scene.obstacles.positions.empty())
        passes.push_back(
            {switches.obstacles_in_cdt == ObstaclesInCdt::triangles ? "obstacle_pass" : "obstacle_vertices", points});
    if (rendered)
        passes.insert(passes.end(),
                      {{"render_background", no_geometry}, {"render_obstacles", points}, {"render_pass", points}});
    const StageInput symmetric{switch_defines(switches)};
    StageInput from_zero = symmetric; // which of the two a run takes is its host's to say
    std::ranges::copy(clip_depth_defines({0.0F, 1.0F}), std::back_inserter(from_zero.defines));
    for (PassStages& pass : passes)
        pass.inputs = {symmetric, from_zero};
    return passes;
}

ShaderUse shader_use(const Scene& scene, const std::filesystem::path& user, bool rendered) {
    ShaderUse use = shader_use("collision", collision_stages(scene, rendered), user);
    for (const std::string& file : use.unused)
        if (const std::string setting = setting_that_runs(file, scene.switches); !setting.empty())
            use.runs_with[file] = setting;
    return use;
}

void compile_unrendered(const Scene& scene, const std::filesystem::path& user) {
    const std::vector<PassStages> all = collision_stages(scene, true);
    compile_alone("collision", std::span(all).subspan(collision_stages(scene, false).size()), user);
}

} // namespace lockstep
