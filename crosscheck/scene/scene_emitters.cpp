#include "crosscheck/scene/scene_emitters.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/scene/scene_settings.hpp"

namespace lockstep {
namespace {

constexpr NumberRule fraction{0.0, 1.0, "a fraction from 0 to 1"};
constexpr NumberRule direction_jitter{0.0, 0.5, "a number from 0 to 0.5"};

Emitter read_emitter(const JsonValue& json) {
    Emitter emitter;
    if (const auto shape = json.find("shape"))
        emitter.shape = static_cast<EmitterShape>(shape->choice({"box", "lattice", "shell"}));
    if (emitter.shape == EmitterShape::shell)
        json.check_keys({"shape", "count", "min", "max", "thickness", "direction", "direction_jitter", "speed",
                         "speed_jitter", "collide_time"});
    else
        json.check_keys(
            {"shape", "count", "min", "max", "direction", "direction_jitter", "speed", "speed_jitter", "collide_time"});
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
    if (const auto time = json.find("collide_time"))
        emitter.collide_time = time->number();
    return emitter;
}

} // namespace

std::vector<Emitter> read_emitters(const JsonValue& json, std::size_t most) {
    std::vector<Emitter> emitters;
    std::size_t total = 0;
    for (const JsonValue& item : json.items()) {
        emitters.push_back(read_emitter(item));
        total += emitters.back().count;
        if (total > most)
            item.fail(fmt::format("{} particles up to here; a scene has at most {}", total, most));
    }
    if (emitters.empty())
        json.fail("no emitters, so no particles; a scene has at least one");
    return emitters;
}

} // namespace lockstep
