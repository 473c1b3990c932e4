#include "reference/dust/draw_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/dust/draw_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {
namespace {

constexpr FieldId clip{corner_buffer, 0}, tint{corner_buffer, 1}, corner_drawn{corner_buffer, 2},
    place{corner_buffer, 3};

std::uint8_t blended(std::uint8_t under, float colour, float alpha) {
    const float sum = std::clamp(colour, 0.0F, 1.0F) * alpha + static_cast<float>(under) / 255.0F * (1.0F - alpha);
    return static_cast<std::uint8_t>(std::lround(std::clamp(sum, 0.0F, 1.0F) * 255.0F));
}

/// A round, soft blob.
float alpha_at(const glm::vec2& texel_place) {
    const glm::vec2 from_centre = texel_place * 2.0F - 1.0F;
    return std::max(0.0F, 1.0F - (from_centre.x * from_centre.x + from_centre.y * from_centre.y));
}

} // namespace

std::unique_ptr<ItemPass> draw_pass(const HostPtr& host, const Drawing& drawing) {
    return item_pass({.name = "draw",
                      .resource = corner_buffer,
                      .stage = PassStage::vertex,
                      .arithmetic = host->settings().arithmetic},
                     DrawTwin{host, drawing});
}

ColorImage draw_image(const SystemView& state, Mesh mesh, ColorImage background) {
    const std::size_t count = state[corner_buffer].count(), each = corners(mesh).size();
    std::vector<glm::vec4> clips(count);
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < count; ++i)
        clips[i] = state.vec4(clip, i);
    for (std::size_t grain = 0; grain < count / each; ++grain)
        if (state.integer(corner_drawn, grain * each) != 0)
            for (const std::uint32_t k : triangles(mesh))
                indices.push_back(static_cast<std::uint32_t>(grain * each) + k);
    const Profile strict;
    draw_triangles(Strict{}, clips, indices, background.width, background.height, strict, [&](std::size_t triangle) {
        const std::uint32_t* const corner = indices.data() + 3 * triangle;
        const std::array places{state.vec2(place, corner[0]), state.vec2(place, corner[1]),
                                state.vec2(place, corner[2])};
        const glm::vec3 colour = mesh == Mesh::cube ? glm::vec3(0.2F) : state.vec3(tint, corner[0]);
        return [&background, mesh, places, colour](int x, int y, const auto& weights, float) {
            const glm::vec2 at =
                places[0] + (places[1] - places[0]) * weights.second + (places[2] - places[0]) * weights.third;
            const float alpha = mesh == Mesh::cube ? 1.0F : alpha_at(at);
            Rgba8& pixel = background.at(x, y);
            pixel = {blended(pixel.r, colour.r * alpha, alpha), blended(pixel.g, colour.g * alpha, alpha),
                     blended(pixel.b, colour.b * alpha, alpha), 255};
        };
    });
    return background;
}

} // namespace lockstep::dust
