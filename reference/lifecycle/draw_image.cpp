#include "reference/lifecycle/draw_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/common.hpp>

#include "reference/arithmetic.hpp"
#include "reference/draw_triangles.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr FieldId clip{corner_buffer, 0}, tint{corner_buffer, 1}, drawn{corner_buffer, 2}, place{corner_buffer, 3};

glm::vec4 shares(const Rgba8& code) { return glm::vec4(code.r, code.g, code.b, code.a) / 255.0F; }

std::uint8_t code_of(float share) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(share, 0.0F, 1.0F) * 255.0F));
}

glm::vec4 texel(const ColorImage& texture, UvOutside outside, int x, int y) {
    glm::vec4 color = shares(texture.at(std::clamp(x, 0, texture.width - 1), std::clamp(y, 0, texture.height - 1)));
    if (!texture.contains(x, y) && outside == UvOutside::transparent)
        color.a = 0.0F;
    return color;
}

glm::vec4 textured(const Sprite& sprite, UvOutside outside, const glm::vec2& place_) {
    const glm::vec2 at = place_ * static_cast<float>(sprite.texture.width);
    const auto texel_at = [&](int x, int y) { return texel(sprite.texture, outside, x, y); };
    if (sprite.filter == Sprite::Filter::nearest)
        return texel_at(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    const glm::vec2 low = glm::floor(at - 0.5F), share = at - 0.5F - low;
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel_at(x, y), texel_at(x + 1, y), share.x),
                    glm::mix(texel_at(x, y + 1), texel_at(x + 1, y + 1), share.x), share.y);
}

/// What a fragment of a sprite or segment shows before it is tinted. Nothing: it is discarded.
std::optional<glm::vec4> look(const Host& host, Emitter::Blend blend, std::uint32_t kind, const glm::vec2& at) {
    if (kind == 2)
        return glm::vec4(1.0F, 1.0F, 1.0F, (at.x - std::floor(at.x) < 0.5F) == (at.y < 0.5F) ? 1.0F : 0.35F);
    const Sprite& sprite = host.settings().sprite;
    if (sprite.texture.width > 0) {
        const glm::vec4 color = textured(sprite, host.switches().uv_outside, at);
        return color.a * 255.0F > static_cast<float>(sprite.alpha_cut) + 0.5F ? std::optional(color) : std::nullopt;
    }
    const glm::vec2 from_centre = at * 2.0F - 1.0F;
    const float alpha = std::max(0.0F, 1.0F - (from_centre.x * from_centre.x + from_centre.y * from_centre.y));
    if (blend == Emitter::Blend::opaque && alpha <= 0.0F)
        return {};
    return glm::vec4(1.0F, 1.0F, 1.0F, alpha);
}

Rgba8 blended(Emitter::Blend blend, const glm::vec4& under, const glm::vec4& color) {
    const glm::vec4 made = glm::clamp(color, 0.0F, 1.0F);
    const glm::vec4 sum = blend == Emitter::Blend::opaque     ? made
                          : blend == Emitter::Blend::additive ? under + glm::clamp(color * color.a, 0.0F, 1.0F)
                                                              : made * made.a + under * (1.0F - made.a);
    return {code_of(sum.r), code_of(sum.g), code_of(sum.b), 255};
}

/// The corners of the triangles that an emitter's quads are drawn as.
std::vector<std::uint32_t> triangles(const Host& host, const HostEmitter& of, const SystemView& state) {
    const std::size_t each = corners_each(host);
    const std::vector<std::uint32_t> of_quad = triangles_each(host);
    std::vector<std::uint32_t> all;
    for (std::size_t quad = of.base; quad < of.base + of.slots; ++quad)
        if (state.word(drawn, each * quad) != 0)
            for (const std::uint32_t corner : of_quad)
                all.push_back(static_cast<std::uint32_t>(each * quad) + corner);
    return all;
}

} // namespace

ColorImage draw_image(const Host& host, const SystemView& state, ColorImage background) {
    std::vector<glm::vec4> clips(state[corner_buffer].count());
    for (std::size_t i = 0; i < clips.size(); ++i)
        clips[i] = state.vec4(clip, i);
    Image<float> nearest(background.width, background.height, 1.0F);
    const Profile strict;
    for (const HostEmitter* const of : drawing_order(host)) {
        const Emitter::Blend blend = of->settings().blend;
        const bool is_opaque = blend == Emitter::Blend::opaque;
        const std::vector<std::uint32_t> indices = triangles(host, *of, state);
        const auto shader = [&](std::size_t triangle) {
            const std::uint32_t* const corner = indices.data() + 3 * triangle;
            const std::array places{state.vec2(place, corner[0]), state.vec2(place, corner[1]),
                                    state.vec2(place, corner[2])};
            const std::array tints{state.vec4(tint, corner[0]), state.vec4(tint, corner[1]),
                                   state.vec4(tint, corner[2])};
            const std::uint32_t kind = state.word(drawn, corner[2]);
            return [&, places, tints, kind](int x, int y, const auto& weights, float depth) {
                const auto between = [&](const auto& each) {
                    return each[0] + (each[1] - each[0]) * weights.second + (each[2] - each[0]) * weights.third;
                };
                const std::optional<glm::vec4> color = look(host, blend, kind, between(places));
                if (!color || !(depth < nearest.at(x, y)))
                    return;
                if (is_opaque)
                    nearest.at(x, y) = depth;
                Rgba8& pixel = background.at(x, y);
                pixel = blended(blend, shares(pixel), *color * between(tints));
            };
        };
        draw_triangles(Strict{}, clips, indices, background.width, background.height, strict, shader);
    }
    return background;
}

} // namespace lockstep::lifecycle
