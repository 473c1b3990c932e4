#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lockstep {

/// A 2D array of texels. Row 0 is the bottom row, as in GL; the centre of texel (x, y) lies at (x + 0.5, y + 0.5)
/// in window coordinates.
template <class Texel> struct Image {
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;

    Image() = default;
    Image(int width_, int height_, Texel fill = Texel{})
        : width(width_), height(height_),
          texels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), fill) {}

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] const Texel& at(int x, int y) const { return texels[index(x, y)]; }
    [[nodiscard]] Texel& at(int x, int y) { return texels[index(x, y)]; }
    [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

/// The collision detection texture (CDT). A texel holds the *stored code* of a world position and its validity:
/// rgba32f and rgba16f the float values themselves (a half is exact in a float), rgba8 the integers 0..255.
/// A cleared texel is all zero; a written one has a nonzero alpha. See collision_code.hpp for the code.
using CollisionImage = Image<glm::vec4>;

/// Window depth, 0 at the near plane, 1 at the far plane and where nothing was drawn.
using DepthImage = Image<float>;

/// 8-bit colour, red first.
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Rgba8&) const = default;
};
using ColorImage = Image<Rgba8>;

} // namespace lockstep
