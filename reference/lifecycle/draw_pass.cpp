#include "reference/lifecycle/draw_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/lifecycle/draw_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr FieldId clip{corner_buffer, 0}, tint{corner_buffer, 1}, drawn{corner_buffer, 2}, place{corner_buffer, 3};

std::uint8_t blended(std::uint8_t under, float colour, float alpha) {
    const float sum = std::clamp(colour, 0.0F, 1.0F) * alpha + static_cast<float>(under) / 255.0F * (1.0F - alpha);
    return static_cast<std::uint8_t>(std::lround(std::clamp(sum, 0.0F, 1.0F) * 255.0F));
}

/// Of a sprite a round, soft blob; of a ribbon a pattern along it.
float alpha_at(std::uint32_t kind, const glm::vec2& at) {
    const glm::vec2 from_centre = at * 2.0F - 1.0F;
    if (kind == 1)
        return std::max(0.0F, 1.0F - (from_centre.x * from_centre.x + from_centre.y * from_centre.y));
    return (at.x - std::floor(at.x) < 0.5F) == (at.y < 0.5F) ? 1.0F : 0.35F;
}

} // namespace

std::unique_ptr<ItemPass> draw_pass(const HostPtr& host, const Drawing& drawing) {
    std::vector<StageGraph> graphs;
    for (const HostEmitter& of : host->emitters())
        graphs.push_back(stage_graph(of.settings().rendering));
    return item_pass({.name = "draw",
                      .resource = corner_buffer,
                      .stage = PassStage::vertex,
                      .arithmetic = host->settings().arithmetic},
                     DrawTwin{host, drawing, std::move(graphs)});
}

ColorImage draw_image(const SystemView& state, ColorImage background) {
    const std::size_t count = state[corner_buffer].count();
    std::vector<glm::vec4> clips(count);
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < count; ++i)
        clips[i] = state.vec4(clip, i);
    for (std::size_t first = 0; first < count; first += 4)
        if (state.word(drawn, first) != 0)
            for (const std::uint32_t k : quad_triangles)
                indices.push_back(static_cast<std::uint32_t>(first) + k);
    const Profile strict;
    draw_triangles(Strict{}, clips, indices, background.width, background.height, strict, [&](std::size_t triangle) {
        const std::uint32_t* const corner = indices.data() + 3 * triangle;
        const std::array places{state.vec2(place, corner[0]), state.vec2(place, corner[1]),
                                state.vec2(place, corner[2])};
        const std::array tints{state.vec4(tint, corner[0]), state.vec4(tint, corner[1]), state.vec4(tint, corner[2])};
        const std::uint32_t kind = state.word(drawn, corner[2]);
        return [&background, places, tints, kind](int x, int y, const auto& weights, float) {
            const auto between = [&](const auto& of) {
                return of[0] + (of[1] - of[0]) * weights.second + (of[2] - of[0]) * weights.third;
            };
            const glm::vec4 colour = between(tints);
            const float alpha = colour.a * alpha_at(kind, between(places));
            Rgba8& pixel = background.at(x, y);
            pixel = {blended(pixel.r, colour.r, alpha), blended(pixel.g, colour.g, alpha),
                     blended(pixel.b, colour.b, alpha), 255};
        };
    });
    return background;
}

} // namespace lockstep::lifecycle
