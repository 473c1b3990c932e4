#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// A shader file that a run takes part of its passes from.
struct UsedShader {
    std::string file;              ///< its name: collision_pass.vert
    std::filesystem::path foreign; ///< where it lies in the user's folder; empty: the shipped one runs
    std::filesystem::path shipped; ///< where the one of that name lies that comes with lockstep; empty: none does
    bool same_as_shipped = false;  ///< a copy, byte by byte
    bool leaves_out = false;       ///< an empty file, with which its stage is left out
    bool is_module = false;        ///< in SPIR-V
    bool is_translated = false;    ///< from it to GLSL, since another stage of its pass is that
};

/// Whose shaders run.
struct ShaderUse {
    /// Every stage that runs, and what stages include from the user's folder where a branch is taken
    /// (taken_branches.hpp).
    std::vector<UsedShader> files;
    std::vector<std::string> unused; ///< shaders in the user's folder that do not, by name
    /// Of unused ones, what has them run: "step=compute" for collision_pass.comp.
    std::map<std::string, std::string> runs_with = {};
};

/// A pass by the name that its files begin with, its stages, and each way in which it is run.
struct PassStages {
    std::string name;
    std::vector<Stage> stages;
    std::vector<StageInput> inputs = {{}};
};

/// Which shaders run in `passes`, of `user` (--shaders DIR; empty: none) and the shipped ones of `system`. Throws Error
/// like load_stages.
ShaderUse shader_use(std::string_view system, std::span<const PassStages> passes, const std::filesystem::path& user);

/// Throws Error unless something of `user` runs, and, but where `allow_unused`, all that is a shader there: a misspelt
/// file or one of another pass would leave the shipped shader in its place, and that agrees.
void check_shader_use(const ShaderUse& use, const std::filesystem::path& user, bool allow_unused = false);

/// "shipped", or file by file whose runs.
std::string shaders_text(const ShaderUse& use);

} // namespace lockstep
