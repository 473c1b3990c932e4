#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// A shader file that a run takes part of its passes from.
struct UsedShader {
    std::string file;              ///< its name: collision_pass.vert
    std::filesystem::path foreign; ///< where it lies in the user's folder; empty: the shipped one runs
    bool same_as_shipped = false;  ///< a copy, byte by byte
    bool leaves_out = false;       ///< an empty file, with which its stage is left out
};

/// Whose shaders run.
struct ShaderUse {
    std::vector<UsedShader> files;   ///< every stage that runs, and what stages include from the user's folder
    std::vector<std::string> unused; ///< shaders in the user's folder that do not, by name
};

/// Which shaders run in a scene, of `user` (--shaders DIR; empty: none) and the shipped ones. `rendered`: the rendered
/// frame is drawn, too. Throws Error like load_stages.
ShaderUse shader_use(const Scene& scene, const std::filesystem::path& user, bool rendered = false);

/// Throws Error unless something of `user` runs, and, but where `allow_unused`, all that is a shader there: a misspelt
/// file or one of another pass would leave the shipped shader in its place, and that agrees.
void check_shader_use(const ShaderUse& use, const std::filesystem::path& user, bool allow_unused = false);

/// "shipped", or file by file whose runs.
std::string shaders_text(const ShaderUse& use);

} // namespace lockstep
