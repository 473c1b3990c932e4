#include "crosscheck/report/overlay.hpp"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace lockstep {
namespace {

constexpr float nearest_w = 1e-3F;

/// The part of a line with w of at least nearest_w; false where there is none.
bool clip_to_front(glm::vec4& a, glm::vec4& b) {
    if (!(a.w >= nearest_w || b.w >= nearest_w))
        return false;
    glm::vec4& behind = a.w < b.w ? a : b;
    const glm::vec4& front = a.w < b.w ? b : a;
    if (behind.w < nearest_w)
        behind += (front - behind) * ((nearest_w - behind.w) / (front.w - behind.w));
    return true;
}

} // namespace

void draw_overlay(ColorImage& image, const glm::mat4& to_clip, std::span<const OverlayLine> lines) {
    const glm::vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
    const auto window = [&](const glm::vec4& clip) {
        return (glm::vec2(clip.x, clip.y) / clip.w * 0.5F + 0.5F) * size;
    };
    for (const OverlayLine& line : lines) {
        glm::vec4 a = to_clip * glm::vec4(line.from, 1.0F), b = to_clip * glm::vec4(line.to, 1.0F);
        if (!clip_to_front(a, b))
            continue;
        const glm::vec2 from = window(a), way = window(b) - from;
        const float longest = std::max(std::abs(way.x), std::abs(way.y));
        const int steps = static_cast<int>(std::clamp(longest, 0.0F, 16384.0F)) + 1;
        for (int i = 0; i <= steps; ++i) {
            const glm::vec2 at = from + way * (static_cast<float>(i) / static_cast<float>(steps));
            if (at.x >= 0.0F && at.y >= 0.0F && at.x < size.x && at.y < size.y)
                image.at(static_cast<int>(at.x), static_cast<int>(at.y)) = line.colour;
        }
    }
}

} // namespace lockstep
