#include "gpu/collision/shader_use.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/collision/collision_shaders.hpp"
#include "gpu/data_folder.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

constexpr std::array points{Stage::vertex, Stage::geometry, Stage::fragment};
constexpr std::array no_geometry{Stage::vertex, Stage::fragment};
constexpr std::array vertex_alone{Stage::vertex};
constexpr std::array compute_alone{Stage::compute};

struct Pass {
    const char* name;
    std::span<const Stage> stages;
};

std::vector<Pass> running_passes(const Scene& scene, bool rendered) {
    const Switches& switches = scene.switches;
    const bool octree = switches.search == Search::octree;
    std::vector<Pass> passes;
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

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_copy(const fs::path& file, const std::string& name) {
    const ShaderFolders shipped = collision_shaders({});
    return std::any_of(shipped.begin(), shipped.end(), [&](const fs::path& folder) {
        return fs::is_regular_file(folder / name) && content(file) == content(folder / name);
    });
}

/// By its ending, or because it begins like one. Copies that editors leave are none.
bool looks_like_shader(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string_view copy : {"~", ".bak", ".orig", ".rej", ".swp"})
        if (name.ends_with(copy))
            return false;
    for (const std::string_view ending :
         {".vert", ".geom",   ".frag",     ".comp",     ".tesc",    ".tese",   ".glsl", ".vs",
          ".gs",   ".fs",     ".cs",       ".vsh",      ".gsh",     ".fsh",    ".csh",  ".vp",
          ".fp",   ".vertex", ".fragment", ".geometry", ".compute", ".shader", ".hlsl", ".spv"})
        if (name.ends_with(ending))
            return true;
    for (const std::string_view pass : {"collision_pass", "obstacle_pass", "obstacle_vertices", "octree_pass",
                                        "layered_", "render_pass", "render_background", "render_obstacles"})
        if (name.starts_with(pass))
            return true;
    return false;
}

bool is_used(const ShaderUse& use, const fs::path& file) {
    return std::any_of(use.files.begin(), use.files.end(), [&](const UsedShader& used) {
        return !used.foreign.empty() && used.foreign.lexically_normal() == file.lexically_normal();
    });
}

void note_stage(ShaderUse& use, const Pass& pass, Stage stage, const ShaderFolders& folders, const fs::path& user) {
    const std::string name = fmt::format("{}{}", pass.name, extension(stage));
    const fs::path own = user.empty() ? fs::path() : user / name;
    const bool foreign = !own.empty() && fs::is_regular_file(own);
    const std::vector<ShaderSource> loaded = load_stages(folders, pass.name, std::span(&stage, 1));
    use.files.push_back({name, foreign ? own : fs::path(), foreign && is_copy(own, name), loaded.empty()});
    if (loaded.empty() || user.empty())
        return;
    const std::string inside = (user / "").string();
    for (const std::string& read : loaded.front().files)
        if (read.starts_with(inside) && !is_used(use, read)) {
            const std::string included = read.substr(inside.size());
            use.files.push_back({included, read, is_copy(read, included), false});
        }
}

std::vector<std::string> stage_names(const ShaderUse& use) {
    std::vector<std::string> names;
    for (const UsedShader& used : use.files)
        if (!used.file.ends_with(".glsl"))
            names.push_back(used.file);
    return names;
}

} // namespace

ShaderUse shader_use(const Scene& scene, const fs::path& user, bool rendered) {
    const ShaderFolders folders = collision_shaders(user);
    ShaderUse use;
    for (const Pass& pass : running_passes(scene, rendered))
        for (const Stage stage : pass.stages)
            note_stage(use, pass, stage, folders, user);
    if (user.empty())
        return use;
    for (const auto& entry : fs::directory_iterator(user)) {
        const std::string name = entry.path().filename().string();
        std::error_code error;
        if (!entry.is_directory(error) && looks_like_shader(name) && !is_used(use, user / name) &&
            !is_copy(entry.path(), name))
            use.unused.push_back(name);
    }
    std::sort(use.unused.begin(), use.unused.end());
    return use;
}

void check_shader_use(const ShaderUse& use, const fs::path& user, bool allow_unused) {
    if (user.empty())
        return;
    const bool none =
        std::all_of(use.files.begin(), use.files.end(), [](const UsedShader& used) { return used.foreign.empty(); });
    if (!use.unused.empty() && (none || !allow_unused))
        throw Error(fmt::format("shader folder {}: {} would not run in this scene with these switches; what can is {}, "
                                "and files they include{}",
                                user.string(), fmt::join(use.unused, ", "), fmt::join(stage_names(use), ", "),
                                none ? "" : "; --allow-unused lets others lie there"));
    if (none)
        throw Error(fmt::format("shader folder {}: nothing in it would run in this scene with these switches; what can "
                                "is {}, and files they include",
                                user.string(), fmt::join(stage_names(use), ", ")));
}

std::string shaders_text(const ShaderUse& use) {
    std::vector<std::string> foreign, shipped;
    for (const UsedShader& used : use.files) {
        const std::string kind = used.leaves_out ? " (left out)" : used.same_as_shipped ? " (as shipped)" : "";
        (used.foreign.empty() ? shipped : foreign)
            .push_back((used.foreign.empty() ? used.file : used.foreign.string()) + kind);
    }
    std::string text = foreign.empty() ? "" : fmt::format("foreign: {}; ", fmt::join(foreign, ", "));
    text += shipped.empty() ? "none shipped" : fmt::format("shipped: {}", fmt::join(shipped, ", "));
    if (!use.unused.empty())
        text += fmt::format("; not run: {}", fmt::join(use.unused, ", "));
    return text;
}

} // namespace lockstep
