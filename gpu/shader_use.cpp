#include "gpu/shader_use.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/taken_branches.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The shipped file of that name; empty: there is none.
fs::path shipped_file(const ShaderFolders& shipped, const std::string& name) {
    const auto folder = std::find_if(shipped.begin(), shipped.end(),
                                     [&](const fs::path& one) { return fs::is_regular_file(one / name); });
    return folder == shipped.end() ? fs::path() : *folder / name;
}

/// A pipe or a device is none, and what is of another size is not read: it may be of any.
bool is_copy(const ShaderFolders& shipped, const fs::path& file, const std::string& name) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        return false;
    return std::any_of(shipped.begin(), shipped.end(), [&](const fs::path& folder) {
        return fs::is_regular_file(folder / name) && fs::file_size(file, error) == fs::file_size(folder / name) &&
               content(file) == content(folder / name);
    });
}

/// The names of the shipped passes, without their endings.
std::set<std::string> shipped_stems(const fs::path& folder) {
    std::set<std::string> stems;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() != ".glsl")
            stems.insert(entry.path().stem().string());
    return stems;
}

/// By its ending, or because it begins like one of `stems`. Copies that editors leave are none.
bool looks_like_shader(std::string name, const std::set<std::string>& stems) {
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
    return std::any_of(stems.begin(), stems.end(), [&](const std::string& stem) { return name.starts_with(stem); });
}

/// A misspelt bindings.json would leave all names unbound.
void check_bindings_name(const fs::path& user) {
    if (fs::is_regular_file(user / bindings_file))
        return;
    if (fs::exists(user / bindings_file))
        throw Error(fmt::format("shader folder {}: {} is no file", user.string(), bindings_file));
    for (const fs::directory_entry& entry : fs::directory_iterator(user)) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(".json") && !nearest_name(name, {std::string(bindings_file)}).empty())
            throw Error(
                fmt::format("shader folder {}: {} is read by nobody; right is {}", user.string(), name, bindings_file));
    }
}

bool is_used(const ShaderUse& use, const fs::path& file) {
    return std::any_of(use.files.begin(), use.files.end(), [&](const UsedShader& used) {
        return !used.foreign.empty() && used.foreign.lexically_normal() == file.lexically_normal();
    });
}

bool is_module(const std::vector<ShaderSource>& stage) { return !stage.empty() && stage.front().module != nullptr; }

/// What a stage takes of the user's folder besides its own file.
void note_included(ShaderUse& use, const ShaderSource& stage, const fs::path& user, const ShaderFolders& shipped) {
    const std::string inside = (user / "").string();
    const auto is_users = [&](const std::string& read) {
        return read.starts_with(inside) && fs::is_regular_file(read) && !is_used(use, read);
    };
    if (std::ranges::none_of(stage.files, is_users))
        return;
    const std::vector<bool> taken = taken_files(stage);
    for (std::size_t file = 0; file < taken.size(); ++file)
        if (const std::string& read = stage.files[file]; // a shipped one may begin like a folder named shaders
            taken[file] && is_users(read)) {
            const std::string included = read.substr(inside.size());
            use.files.push_back(
                {included, read, shipped_file(shipped, included), is_copy(shipped, read, included), false});
        }
}

void note_stage(ShaderUse& use, const PassStages& pass, Stage stage, const ShaderFolders& folders,
                const fs::path& user) {
    const std::string name = fmt::format("{}{}", pass.name, extension(stage));
    fs::path own = user.empty() ? fs::path() : user / name;
    if (!own.empty() && !fs::exists(own) && fs::is_regular_file(user / (name + ".spv")))
        own += ".spv"; // a module
    const bool foreign = !own.empty() && fs::is_regular_file(own);
    const ShaderFolders shipped(folders.begin() + (user.empty() ? 0 : 1), folders.end());
    const auto load = [&](const StageInput& input) {
        return load_stages(folders, pass.name, std::span(&stage, 1), input.defines, input.texts);
    };
    const std::vector<ShaderSource> loaded = load(pass.inputs.front());
    use.files.push_back({name, foreign ? own : fs::path(), shipped_file(shipped, name),
                         foreign && is_copy(shipped, own, name), loaded.empty(), is_module(loaded)});
    if (loaded.empty() || user.empty())
        return;
    note_included(use, loaded.front(), user, shipped);
    for (const StageInput& input : std::span(pass.inputs).subspan(1))
        note_included(use, load(input).front(), user, shipped);
}

std::vector<std::string> stage_names(const ShaderUse& use) {
    std::vector<std::string> names;
    for (const UsedShader& used : use.files)
        if (!used.file.ends_with(".glsl"))
            names.push_back(used.file);
    return names;
}

} // namespace

ShaderUse shader_use(std::string_view system, std::span<const PassStages> passes, const fs::path& user) {
    const ShaderFolders folders = shader_folders(user, system);
    ShaderUse use;
    for (const PassStages& pass : passes) {
        const std::size_t first = use.files.size();
        for (const Stage stage : pass.stages)
            note_stage(use, pass, stage, folders, user);
        const std::span<UsedShader> of_pass(use.files.begin() + static_cast<std::ptrdiff_t>(first), use.files.end());
        const bool has_text = std::any_of(of_pass.begin(), of_pass.end(), [](const UsedShader& used) {
            return !used.is_module && !used.leaves_out && !used.file.ends_with(".glsl");
        });
        for (UsedShader& used : of_pass)
            used.is_translated = used.is_module && has_text;
    }
    if (user.empty())
        return use;
    const ShaderFolders shipped = shader_folders({}, system);
    const std::set<std::string> stems = shipped_stems(shipped.front());
    for (const auto& entry : fs::directory_iterator(user)) {
        const std::string name = entry.path().filename().string();
        std::error_code error;
        if (!entry.is_directory(error) && looks_like_shader(name, stems) && !is_used(use, user / name) &&
            !is_copy(shipped, entry.path(), name))
            use.unused.push_back(name);
    }
    std::sort(use.unused.begin(), use.unused.end());
    return use;
}

void check_shader_use(const ShaderUse& use, const fs::path& user, bool allow_unused) {
    if (user.empty())
        return;
    check_bindings_name(user);
    const bool none =
        std::all_of(use.files.begin(), use.files.end(), [](const UsedShader& used) { return used.foreign.empty(); });
    std::string right;
    if (std::any_of(use.unused.begin(), use.unused.end(),
                    [](const std::string& file) { return file.ends_with(".spv"); }))
        right = "; a module is named as its stage, and .spv: collision_pass.vert.spv";
    for (const auto& [file, setting] : use.runs_with)
        right += fmt::format("; {} runs with --set {}", file, setting);
    if (!use.unused.empty() && (none || !allow_unused))
        throw Error(fmt::format("shader folder {}: {} would not run in this scene with these switches; what can is {}, "
                                "and files they include{}{}",
                                user.string(), fmt::join(use.unused, ", "), fmt::join(stage_names(use), ", "), right,
                                none ? "" : "; --allow-unused lets others lie there"));
    if (none)
        throw Error(fmt::format("shader folder {}: nothing in it would run in this scene with these switches; what can "
                                "is {}, and files they include",
                                user.string(), fmt::join(stage_names(use), ", ")));
}

std::string shaders_text(const ShaderUse& use) {
    std::vector<std::string> foreign, shipped;
    for (const UsedShader& used : use.files) {
        const std::string kind = used.leaves_out        ? " (left out)"
                                 : used.is_translated   ? " (translated to GLSL, which another stage is)"
                                 : used.is_module       ? " (SPIR-V)"
                                 : used.same_as_shipped ? " (as shipped)"
                                                        : "";
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
