#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reference/model/collision/scene.hpp"

namespace lockstep {

class NamedFiles;

/// What the command line changes in a scene.
struct SceneOptions {
    std::optional<std::size_t> particles = {}; ///< in all; emitters keep their proportions
    std::optional<std::string> preset = {};    ///< instead of the scene's; the scene's switches still apply on top
    std::vector<std::string> set = {};         ///< "name=value": a switch or a constant ("gravity=0,-1,0"), last of all
    std::shared_ptr<NamedFiles> files = {}; ///< where a registered system's scene has its files from; null: beside it
    float emitter_length = 1.0F;            ///< factor on the emitters' boxes, see scale_lengths
};

/// Particles a scene may have.
inline constexpr std::size_t most_particles = 100'000'000;

/// Reads a scene (docs/scenes.md has every key), validates it and makes it ready to run. Mesh files are found
/// relative to the scene file. Throws Error: `FILE: /json/pointer: what is wrong and what is allowed`.
Scene load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

/// The same of a file that was read; `file` is where it lies.
Scene read_scene(const nlohmann::json& document, const std::filesystem::path& file, const SceneOptions& options = {});

/// The files that a scene is read from: its own, and its meshes.
std::vector<std::filesystem::path> scene_files(const nlohmann::json& document, const std::filesystem::path& file);

} // namespace lockstep
