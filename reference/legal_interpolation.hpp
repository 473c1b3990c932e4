#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/interval.hpp"
#include "reference/model/clip_space.hpp"
#include "reference/model/window_accuracy.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {

/// What may be interpolated at a pixel's centre; of the last steps, from shares to a value, rounding comes on top
/// (interpolation_bound, depth_bound).
struct LegalFragment {
    std::array<Interval, 3> position;
    Interval depth; ///< as ClipDepth has it
};

/// TriangleInterpolation (triangle_interpolation.hpp) of corners in clip space that may lie anywhere in sets, as where
/// the order of a vertex stage's sums is open: + and * are rounded (half an ULP), quotients right to 2.5 ULP and again
/// rounded. What may be seen edge-on has the whole triangle.
inline LegalFragment legal_fragment(const std::array<std::array<Interval, 4>, 3>& clip,
                                    const std::array<glm::vec3, 3>& positions, int x, int y, int width, int height,
                                    const ClipDepth& depth = {}) {
    using namespace interval;
    const auto sum_of = [](Interval a, Interval b) { return widen(add(a, b), 0.5); };
    const auto product_of = [](Interval a, Interval b) { return widen(multiply(a, b), 0.5); };
    const auto relative = [&](const std::array<Interval, 4>& corner, std::size_t axis, int size, int pixel) {
        const auto centre = static_cast<double>(2 * pixel + 1 - size), half_pixels = static_cast<double>(size);
        return add(multiply(corner[axis], {half_pixels, half_pixels}), negate(multiply(corner[3], {centre, centre})));
    };
    std::array<Interval, 3> rx, ry;
    for (std::size_t k = 0; k < 3; ++k) {
        rx[k] = relative(clip[k], 0, width, x);
        ry[k] = relative(clip[k], 1, height, y);
    }
    const auto edge = [&](std::size_t from, std::size_t to) {
        return sum_of(product_of(rx[from], ry[to]), negate(product_of(rx[to], ry[from])));
    };
    const Interval first = edge(1, 2), second = edge(2, 0), third = edge(0, 1);
    const Interval sum = sum_of(sum_of(first, second), third);
    // Clamped as there: the second to 1, the third to what the second leaves.
    const auto share = [&](Interval side, Interval most) {
        const Interval quotient = widen(divide(side, sum), 3.0);
        return quotient.any
                   ? Interval(0.0, most.high)
                   : Interval(std::clamp(quotient.low, 0.0, most.low), std::clamp(quotient.high, 0.0, most.high));
    };
    const Interval of_second = share(second, 1.0F);
    const Interval of_third = share(third, widen(add(1.0F, negate(of_second)), 0.5));
    const auto mix = [&](Interval a, Interval b, Interval c) {
        const Interval mixed =
            add(add(a, multiply(of_second, add(b, negate(a)))), multiply(of_third, add(c, negate(a))));
        const Interval corners = hull(hull(a, b), c);
        return mixed.any || corners.any
                   ? corners
                   : Interval(std::max(mixed.low, corners.low), std::min(mixed.high, corners.high));
    };
    LegalFragment fragment;
    for (int c = 0; c < 3; ++c)
        fragment.position[static_cast<std::size_t>(c)] = mix(positions[0][c], positions[1][c], positions[2][c]);
    const Interval ndc = divide(mix(clip[0][2], clip[1][2], clip[2][2]), mix(clip[0][3], clip[1][3], clip[2][3]));
    const double scale = std::abs(depth.scale()), offset = std::abs(depth.offset());
    const auto window = [&](double z) { return std::clamp(scale * z + offset, 0.0, 1.0); };
    fragment.depth = ndc.any ? Interval(0.0, 1.0) : Interval(window(ndc.low), window(ndc.high));
    if (depth.reversed())
        fragment.depth = negate(fragment.depth);
    return fragment;
}

/// The row that a profile does not follow where a fragment stage takes what the driver interpolates over a triangle,
/// which no probe measures: it depends on the triangle.
inline constexpr std::string_view driver_interpolates_row = "triangles: interpolation";

/// By how much more may differ what the driver interpolates: each component, and the window depth.
struct DriverInterpolation {
    glm::vec3 position{0.0F};
    double depth = 0.0;
};

/// GL gives the equations (4.5, 14.6.1) and for operations of fixed function 1 part in 10^5 (2.3.4.1), here of the
/// largest corner; and the driver may evaluate them over corners that its grid has moved by `step` pixels, each along x
/// and y by itself. A share is a quotient that is linear in each of these six, above and below the line, so the most
/// lies where each is moved all the way. Of a triangle that may be seen edge-on then, all of it is legal.
template <class A> DriverInterpolation driver_interpolation(A fp, const std::array<glm::vec4, 3>& clip,
                                                            const std::array<glm::vec3, 3>& corners, int x, int y,
                                                            int width, int height, const ClipDepth& depth,
                                                            double step) {
    struct Fragment {
        glm::dvec3 position;
        double ndc, sum;
    };
    const auto fragment = [&](const std::array<glm::vec4, 3>& placed) {
        const auto edges = TriangleInterpolation<A>(fp, placed, width, height, depth).edges(x, y);
        const glm::dvec3 sides(edges.first, edges.second, edges.third);
        Fragment at{glm::dvec3(0.0), 0.0, sides.x + sides.y + sides.z};
        double z = 0.0, w = 0.0;
        for (int k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::size_t>(k);
            at.position += sides[k] / at.sum * glm::dvec3(corners[corner]);
            z += sides[k] * double{clip[corner].z};
            w += sides[k] * double{clip[corner].w};
        }
        at.ndc = z / w;
        return at;
    };
    const glm::vec3 least = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::vec3 most = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const TriangleInterpolation<A> exact(fp, clip, width, height, depth);
    const auto weights = exact.weights(x, y);
    const glm::dvec3 here(exact.mix(fp, corners, weights));
    const double depth_here = exact.depth(weights), sum = fragment(clip).sum;
    glm::dvec3 moved_by(0.0);
    double deeper = 0.0;
    for (unsigned moves = 0; moves < 64; ++moves) {
        std::array<glm::vec4, 3> moved = clip;
        for (unsigned k = 0; k < 3; ++k) {
            const double pixels = step * 2.0 * double{clip[k].w};
            const auto by = [&](unsigned bit, int size) {
                return static_cast<float>(((moves >> bit & 1U) != 0 ? pixels : -pixels) / size);
            };
            moved[k].x += by(2 * k, width);
            moved[k].y += by(2 * k + 1, height);
        }
        const Fragment there = fragment(moved);
        if (!(sum * there.sum > 0.0))
            return {most - least, 1.0};
        const glm::dvec3 position = glm::clamp(there.position, glm::dvec3(least), glm::dvec3(most));
        moved_by = glm::max(moved_by, glm::abs(position - here));
        const double window = std::clamp(std::abs(depth.scale()) * there.ndc + std::abs(depth.offset()), 0.0, 1.0);
        deeper = std::max(deeper, std::abs(double{depth.sign()} * window - depth_here));
    }
    const glm::vec3 largest = glm::max(glm::abs(least), glm::abs(most));
    return {glm::vec3(moved_by) + static_cast<float>(gl_window_accuracy.ndc) * largest,
            deeper + gl_window_accuracy.ndc};
}

} // namespace lockstep
