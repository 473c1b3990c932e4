#include "crosscheck/scene/scene_file.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "crosscheck/scene/scene_emitters.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/collision/emitters.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t largest_seed = (std::int64_t{1} << 53) - 1; // every JSON reader keeps it

} // namespace

Scene load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    return read_scene(read_json(file), file, options);
}

Scene read_scene(const nlohmann::json& document, const std::filesystem::path& file, const SceneOptions& options) {
    if (options.particles && (*options.particles < 1 || *options.particles > most_particles))
        throw Error(fmt::format("--particles {}: not an integer from 1 to {}", *options.particles, most_particles));

    const JsonValue json(document, file.string());
    if (const auto system = json.find("system"))
        static_cast<void>(system->choice({"collision"}));
    json.check_keys(scene_keys);
    Scene scene;
    scene.name = plain_line(file.stem().string());
    scene.origin = scene_arguments(file, options);
    read_settings(json, options.preset, options.set, scene);

    std::vector<Emitter> emitters = read_emitters(json.at("emitters"));
    const auto seed_value = json.find("seed");
    const std::int64_t seed = seed_value ? seed_value->integer(0, largest_seed) : 1;
    if (const auto obstacles = json.find("obstacles"))
        scene.obstacles = read_obstacles(*obstacles, file.parent_path());

    if (options.particles)
        scale_counts(emitters, *options.particles);
    if (options.emitter_length != 1.0F)
        scale_lengths(emitters, options.emitter_length);
    scene.start = emit(emitters, static_cast<std::uint64_t>(seed));
    return scene;
}

std::vector<std::filesystem::path> scene_files(const nlohmann::json& document, const std::filesystem::path& file) {
    std::vector<std::filesystem::path> files{file};
    if (const auto obstacles = JsonValue(document, file.string()).find("obstacles"))
        for (const JsonValue& obstacle : obstacles->items())
            if (const auto mesh = obstacle.find("file"))
                files.push_back(file.parent_path() / mesh->text());
    return files;
}

} // namespace lockstep
