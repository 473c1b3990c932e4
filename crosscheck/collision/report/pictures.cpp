#include "crosscheck/collision/report/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/model/ulp.hpp"

namespace lockstep {
namespace {

constexpr Rgba8 empty{18, 20, 26, 255};
constexpr Rgba8 equal{120, 124, 132, 255};
constexpr Rgba8 value_differs{230, 60, 50, 255};
constexpr Rgba8 one_side_only{250, 200, 60, 255};

bool drawn(const glm::vec4& texel) { return texel.a != 0.0F; }

std::uint8_t shade(float value, float low, float high) {
    const float t = high > low ? (value - low) / (high - low) : 0.5F;
    return static_cast<std::uint8_t>(60.0F + 195.0F * (t == t ? std::clamp(t, 0.0F, 1.0F) : 0.0F));
}

bool same(const glm::vec4& a, const glm::vec4& b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z) && same_bits(a.w, b.w);
}

} // namespace

Box code_box(const CollisionImage& cdt) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    Box box{glm::vec3(inf), glm::vec3(-inf)};
    for (const glm::vec4& texel : cdt.texels) {
        if (!drawn(texel) || !std::isfinite(texel.x + texel.y + texel.z))
            continue;
        box.min = {std::min(box.min.x, texel.x), std::min(box.min.y, texel.y), std::min(box.min.z, texel.z)};
        box.max = {std::max(box.max.x, texel.x), std::max(box.max.y, texel.y), std::max(box.max.z, texel.z)};
    }
    return box;
}

ColorImage picture(const CollisionImage& cdt, const Box& box) {
    ColorImage image(cdt.width, cdt.height, empty);
    for (std::size_t i = 0; i < cdt.texels.size(); ++i) {
        const glm::vec4& t = cdt.texels[i];
        if (drawn(t))
            image.texels[i] = {shade(t.x, box.min.x, box.max.x), shade(t.y, box.min.y, box.max.y),
                               shade(t.z, box.min.z, box.max.z), 255};
    }
    return image;
}

ColorImage difference_picture(const CollisionImage& reference, const CollisionImage& gpu) {
    ColorImage image(reference.width, reference.height, empty);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const glm::vec4& a = reference.texels[i];
        const glm::vec4& b = gpu.texels[i];
        if (drawn(a) != drawn(b))
            image.texels[i] = one_side_only;
        else if (!same(a, b))
            image.texels[i] = value_differs;
        else if (drawn(a))
            image.texels[i] = equal;
    }
    return image;
}

} // namespace lockstep
