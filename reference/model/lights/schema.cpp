#include "reference/model/lights/schema.hpp"

#include <array>
#include <map>
#include <tuple>

namespace lockstep::lights {
namespace {

Resource image(const char* name, const char* item, const char* title, int dimensions, const char* format, Field field) {
    field.name = name;
    return {.name = name,
            .item = item,
            .title = title,
            .fields = {std::move(field)},
            .dimensions = dimensions,
            .format = format};
}

Schema made(bool floats, bool half_volume, bool half_gbuffer, bool srgb) {
    const char* const volume = half_volume ? "rgba16f" : "rgba32f";
    const char* const gbuffer = half_gbuffer ? "rgba16f" : "rgba32f";
    const Field four{.name = {}, .components = 4}, codes{.name = {}, .scalar = Scalar::uint32, .components = 4};
    const Field word{.name = {}, .scalar = floats ? Scalar::float32 : Scalar::uint32};
    return checked({"lights",
                    {{.name = "lights",
                      .item = "light",
                      .title = "the lights",
                      .fields = {{.name = "position", .components = 3, .unit = "m"},
                                 {.name = "range", .unit = "m"},
                                 {.name = "direction", .components = 3},
                                 {.name = "speed", .unit = "m/s"},
                                 {.name = "colour", .components = 3},
                                 {.name = "inv_range2", .unit = "1/m2"},
                                 {.name = "spare", .components = 4}}},
                     image("accumulator", "word", "the accumulator", 3, floats ? "r32f" : "r32ui", word),
                     {.name = "cells",
                      .item = "cell",
                      .title = "the cells",
                      .fields = {{.name = "cell_count", .scalar = Scalar::uint32, .block = "cellBuffer"},
                                 {.name = "cell_start", .scalar = Scalar::uint32, .block = "cellBuffer"}}},
                     {.name = "sorted",
                      .item = "place",
                      .title = "the lights by cell",
                      .fields = {{.name = "light", .scalar = Scalar::uint32, .block = "sortedBuffer"}}},
                     image("light_color", "voxel", "the colour texture", 3, volume, four),
                     image("light_direction", "voxel", "the direction texture", 3, volume, four),
                     image("surface_position", "pixel", "the positions", 2, gbuffer, four),
                     image("surface_normal", "pixel", "the normals", 2, gbuffer, four),
                     image("surface_albedo", "pixel", "the albedo", 2, "rgba8", codes),
                     image("surface_depth", "pixel", "the depth", 2, "r32f", Field{.name = {}}),
                     image("lit", "pixel", "the lit image", 2, "rgba32f", four),
                     image("encoded", "pixel", "the encoded image", 2, srgb ? "srgb8_alpha8" : "rgba8", codes),
                     {.name = "corners",
                      .item = "corner",
                      .title = "the obstacles",
                      .fields = {{.name = "corner_position", .components = 3, .unit = "m"},
                                 {.name = "corner_albedo", .components = 3}}}}});
}

Extent extent(const glm::ivec3& size, int times) {
    return {static_cast<std::size_t>(size.x), static_cast<std::size_t>(size.y),
            static_cast<std::size_t>(size.z) * static_cast<std::size_t>(times)};
}

} // namespace

const Schema& schema(const Switches& s) {
    using Key = std::array<bool, 4>;
    static const std::map<Key, Schema> all = [] {
        std::map<Key, Schema> every;
        for (int k = 0; k < 16; ++k) {
            const Key key{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0};
            every.emplace(key, made(key[0], key[1], key[2], key[3]));
        }
        return every;
    }();
    return all.at({adds_floats(s.accumulate), s.volume_format == Format::rgba16f, s.gbuffer_format == Format::rgba16f,
                   s.encoding == Encoding::srgb_hw});
}

SystemState start(const Settings& s) {
    const Switches& on = s.switches;
    const Extent one{1, 1, 1};
    const Extent image{static_cast<std::size_t>(s.width), static_cast<std::size_t>(s.height), 1};
    const Extent volume = extent(s.grid.size, 1);
    const bool sorts = on.accumulate == Accumulate::gather, stores = on.pipeline == Pipeline::deferred;
    const Extent gbuffer = stores ? image : one;
    SystemState state(schema(on), {{s.lights.size()},
                                   scatters(on.accumulate) ? extent(s.grid.size, channels(on.accumulate)) : one,
                                   {sorts ? s.grid.count() : 1},
                                   {sorts ? s.lights.size() : 1},
                                   volume,
                                   volume,
                                   gbuffer,
                                   gbuffer,
                                   gbuffer,
                                   image,
                                   image,
                                   image,
                                   {s.obstacles.mesh.indices.size()}});
    for (std::size_t i = 0; i < s.lights.size(); ++i) {
        const Light& light = s.lights[i];
        state.set(field::light_position, i, light.position);
        state.set(field::range, i, light.range);
        state.set(field::light_direction, i, light.direction);
        state.set(field::speed, i, light.speed);
        state.set(field::light_colour, i, light.colour);
        state.set(field::inv_range2, i, static_cast<float>(1.0 / (double{light.range} * double{light.range})));
    }
    for (std::size_t i = 0; i < s.obstacles.mesh.indices.size(); ++i) {
        state.set(field::corner_position, i, s.obstacles.mesh.positions[s.obstacles.mesh.indices[i]]);
        state.set(field::corner_albedo, i, glm::vec3(s.obstacles.albedo[i / 3]) / 256.0F);
    }
    return state;
}

} // namespace lockstep::lights
