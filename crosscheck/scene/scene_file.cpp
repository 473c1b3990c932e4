#include "crosscheck/scene/scene_file.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "crosscheck/scene/scene_emitters.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "crosscheck/scene/start_file.hpp"
#include "reference/model/collision/emitters.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t largest_seed = (std::int64_t{1} << 53) - 1; // every JSON reader keeps it

Particles emitted(const JsonValue& json, const SceneOptions& options, const Switches& switches) {
    std::vector<Emitter> emitters = read_emitters(json.at("emitters"));
    const auto seed_value = json.find("seed");
    const std::int64_t seed = seed_value ? seed_value->integer(0, largest_seed) : 1;
    if (options.particles)
        scale_counts(emitters, *options.particles);
    if (options.emitter_length != 1.0F)
        scale_lengths(emitters, options.emitter_length);
    Particles particles = emit(emitters, static_cast<std::uint64_t>(seed));
    hold_velocity(particles, switches);
    return particles;
}

Particles started(const JsonValue& start, const JsonValue& scene, const std::filesystem::path& folder,
                  const SceneOptions& options, const Switches& switches) {
    for (const char* key : {"emitters", "seed"})
        if (scene.find(key))
            start.fail(fmt::format("is there beside {}; right is one of both", key));
    Particles particles = read_start(folder / start.text(), switches);
    if (options.particles && *options.particles != particles.size())
        throw Error(fmt::format("--particles {}: {} has {} particles, which no option changes", *options.particles,
                                (folder / start.text()).string(), particles.size()));
    return particles;
}

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

    if (const auto obstacles = json.find("obstacles"))
        scene.obstacles = read_obstacles(*obstacles, file.parent_path());

    const auto start = json.find("start");
    scene.start = start ? started(*start, json, file.parent_path(), options, scene.switches)
                        : emitted(json, options, scene.switches);
    return scene;
}

std::vector<std::filesystem::path> scene_files(const nlohmann::json& document, const std::filesystem::path& file) {
    std::vector<std::filesystem::path> files{file};
    if (const auto obstacles = JsonValue(document, file.string()).find("obstacles"))
        for (const JsonValue& obstacle : obstacles->items())
            if (const auto mesh = obstacle.find("file"))
                files.push_back(file.parent_path() / mesh->text());
    if (const auto start = JsonValue(document, file.string()).find("start"); start && start->is_text())
        files.push_back(file.parent_path() / start->text());
    return files;
}

} // namespace lockstep
