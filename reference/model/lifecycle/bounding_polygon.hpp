#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

/// The polygon of least area, of few corners, that holds all of a sprite that is to be seen (Aggarwal, Chang and Yap,
/// "Minimum area circumscribing polygons", 1985; DePano's lemma: all of its sides but one contain an edge of the hull,
/// the last does too or touches it at its own middle).
namespace lockstep::lifecycle {

/// In half texels, y up.
struct LatticePoint {
    std::int64_t x = 0, y = 0;
    bool operator==(const LatticePoint&) const = default;
};

enum class HullPoints { centres, corners, bilinear };

/// Of each row of an image the outermost texels whose alpha is above `cut`. `alpha`: size * size codes, row 0 below.
/// Texel (x, y) has its centre at (2 x + 1, 2 y + 1).
std::vector<LatticePoint> outermost(std::span<const std::uint8_t> alpha, int size, int cut, HullPoints points);

/// Graham's scan: counterclockwise from the lowest, then leftmost point; without points on a side. Fewer than three
/// where all lie on a line.
std::vector<LatticePoint> convex_hull(std::vector<LatticePoint> points);

/// Of a counterclockwise polygon.
double area(std::span<const glm::dvec2> polygon);

/// A polygon of at most `k` corners around a hull. `flush`: the edges of the hull that its sides contain, in order;
/// `pivot`: the vertex at which the last side is halved.
struct Bounding {
    std::vector<glm::dvec2> corners; ///< counterclockwise
    double area = 0.0;
    std::vector<std::size_t> flush;
    std::optional<std::size_t> pivot;
};

/// The least of them; the hull itself where it has no more corners. Nothing where no such polygon closes: a hull of few
/// directions, or k < 3. Time O(k n^3) for n edges.
std::optional<Bounding> least_polygon(std::span<const glm::dvec2> hull, std::size_t k);

/// The same with its corners on multiples of 1/4096 texel, moved outwards until every point of the hull is inside by
/// exact integers; the bounding rectangle where that fails, or where there is none. Texels, from the lower left corner
/// of the image; the first corner is the leftmost, then lowest. Empty for an empty hull.
std::vector<glm::dvec2> sprite_polygon(std::span<const LatticePoint> hull, std::size_t k);

} // namespace lockstep::lifecycle
