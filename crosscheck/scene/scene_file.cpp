#include "crosscheck/scene/scene_file.hpp"

#include <cstdint>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/collision/emitters.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t largest_seed = (std::int64_t{1} << 53) - 1; // every JSON reader keeps it
constexpr NumberRule fraction{0.0, 1.0, "a fraction from 0 to 1"};
constexpr NumberRule direction_jitter{0.0, 0.5, "a number from 0 to 0.5"};

Emitter read_emitter(const JsonValue& json) {
    Emitter emitter;
    if (const auto shape = json.find("shape"))
        emitter.shape = static_cast<EmitterShape>(shape->choice({"box", "lattice", "shell"}));
    if (emitter.shape == EmitterShape::shell)
        json.check_keys(
            {"shape", "count", "min", "max", "thickness", "direction", "direction_jitter", "speed", "speed_jitter"});
    else
        json.check_keys({"shape", "count", "min", "max", "direction", "direction_jitter", "speed", "speed_jitter"});
    emitter.count = static_cast<std::size_t>(json.at("count").integer(1, most_particles));
    emitter.box = read_box(json);
    if (const auto thickness = json.find("thickness"))
        emitter.thickness = thickness->number(fraction);
    if (const auto direction = json.find("direction")) {
        emitter.direction = direction->vector();
        if (!(glm::length(glm::dvec3(emitter.direction)) > 0.0))
            direction->fail("a direction has a length above 0");
    }
    if (const auto jitter = json.find("direction_jitter"))
        emitter.direction_jitter = jitter->number(direction_jitter);
    if (const auto speed = json.find("speed"))
        emitter.speed = speed->number(number::not_negative);
    if (const auto jitter = json.find("speed_jitter"))
        emitter.speed_jitter = jitter->number(fraction);
    return emitter;
}

std::vector<Emitter> read_emitters(const JsonValue& json) {
    std::vector<Emitter> emitters;
    std::size_t total = 0;
    for (const JsonValue& item : json.items()) {
        emitters.push_back(read_emitter(item));
        total += emitters.back().count;
        if (total > most_particles)
            item.fail(fmt::format("{} particles up to here; a scene has at most {}", total, most_particles));
    }
    if (emitters.empty())
        json.fail("no emitters, so no particles; a scene has at least one");
    return emitters;
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
