#include "reference/model/fluid/schema.hpp"

#include <array>
#include <utility>

#include <glm/vec4.hpp>

namespace lockstep::fluid {
namespace {

Resource image(const char* name, const char* title, const char* format, Field field) {
    field.name = name;
    return {
        .name = name, .item = "pixel", .title = title, .fields = {std::move(field)}, .dimensions = 2, .format = format};
}

Schema made(bool words, bool srgb) {
    const Field one{.name = {}}, metres{.name = {}, .unit = "m"}, four{.name = {}, .components = 4},
        codes{.name = {}, .scalar = Scalar::uint32, .components = 4}, word{.name = {}, .scalar = Scalar::uint32};
    return checked({"fluid",
                    {{.name = "particles",
                      .item = "particle",
                      .title = "the particles",
                      .fields = {{.name = "position", .components = 4, .unit = "m"}}},
                     image("scene", "the scene", "rgba32f", four),
                     image("scene_depth", "the scene's depth", "r32f", one),
                     image("depth", "the depth of the spheres", "r32f", one),
                     image("smooth_depth", "the filtered depth", "r32f", one),
                     image("normal", "the normals", "rgba32f", four),
                     image("thickness", "the thickness", words ? "r32ui" : "r32f", words ? word : metres),
                     image("lit", "the lit image", "rgba32f", four),
                     image("encoded", "the encoded image", srgb ? "srgb8_alpha8" : "rgba8", codes),
                     {.name = "corners",
                      .item = "corner",
                      .title = "the obstacles",
                      .fields = {{.name = "corner_position", .components = 3, .unit = "m"}}}}});
}

} // namespace

const Schema& schema(const Switches& s) {
    static const std::array<Schema, 4> all{made(false, false), made(true, false), made(false, true), made(true, true)};
    const std::size_t words = s.thickness_sum == ThicknessSum::fixed ? 1 : 0;
    return all[words + (s.encoding == Encoding::srgb_hw ? 2 : 0)];
}

SystemState start(const Settings& s) {
    const Extent image{static_cast<std::size_t>(s.width), static_cast<std::size_t>(s.height), 1}, one{1, 1, 1};
    const Mesh& mesh = s.obstacles;
    SystemState state(schema(s.switches), {{s.particles.size()},
                                           image,
                                           image,
                                           image,
                                           s.switches.filter == Filter::off ? one : image,
                                           image,
                                           image,
                                           image,
                                           image,
                                           {mesh.indices.empty() ? 3 : mesh.indices.size()}});
    for (std::size_t i = 0; i < s.particles.size(); ++i)
        state.set(field::position, i, glm::vec4(s.particles[i], 1.0F));
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        state.set(field::corner_position, i, mesh.positions[mesh.indices[i]]);
    return state;
}

} // namespace lockstep::fluid
