#include "gpu/stages_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/data_folder.hpp"
#include "gpu/program.hpp"

namespace lockstep {
namespace {

bool is_foreign(const UsedShader& used) { return !used.foreign.empty(); }

void note_compiled(ShaderUse& use, const UsedShader& used) {
    const std::string text = fmt::format("{} (compiled)", used.foreign.filename().string());
    if (std::ranges::find(use.unused, text) == use.unused.end())
        use.unused.push_back(text);
}

/// Whether a file of the user's has the name of one that comes with lockstep (ShaderSource::files).
bool is_built_in(const std::filesystem::path& file) {
    const std::filesystem::path inside = file.lexically_relative(built_in_shaders());
    return !inside.empty() && *inside.begin() != "..";
}

} // namespace

std::set<std::string>& shaders_run() {
    static std::set<std::string> all;
    return all;
}

void forget_shaders_run() { shaders_run().clear(); }

void add_compiled(ShaderUse& use, const ShaderUse& whole) {
    for (const UsedShader& used : whole.files)
        if (is_foreign(used) && std::ranges::find(use.files, used.foreign, &UsedShader::foreign) == use.files.end())
            note_compiled(use, used);
}

void compile_alone(std::string_view system, std::span<const PassStages> passes, const std::filesystem::path& user) {
    if (user.empty())
        return;
    for (const PassStages& pass : passes)
        if (std::ranges::any_of(shader_use(system, {&pass, 1}, user).files, is_foreign)) {
            const StageInput& input = pass.inputs.front();
            const Program linked(pass.name, load_stages(shader_folders(user, system), pass.name, pass.stages,
                                                        input.defines, input.texts));
        }
}

void note_what_ran(ShaderUse& use) {
    const auto idle = std::stable_partition(use.files.begin(), use.files.end(), [](const UsedShader& used) {
        return !is_foreign(used) || used.leaves_out || is_built_in(used.foreign) ||
               shaders_run().contains(used.foreign.string());
    });
    for (auto used = idle; used != use.files.end(); ++used)
        note_compiled(use, *used);
    use.files.erase(idle, use.files.end());
}

} // namespace lockstep
