#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "reference/interval.hpp"

namespace lockstep::fluid {

/// The points of a normal, each on a ray of its own from the eye: how far along the view, m, and where a ray is at 1 m.
/// The first is the pixel's.
struct PointsOnRays {
    std::array<Interval, 3> forward;
    std::array<glm::dvec3, 3> ray; ///< z is -1
};

namespace unit_normal_rules {

inline constexpr double rounding = 0x1p-24;
/// What a point's x and y err by, of their size: a quotient (2.5 ULP), two products.
inline constexpr double of_point = 7.0 * rounding;
/// What a cross product errs by, of the product of its factors' lengths: differences, products, sums in any order.
inline constexpr double of_cross = 8.0 * rounding;
/// What normalize errs by, of components up to 1.
inline constexpr double of_normalize = 0x1p-18;

using Ends = std::array<double, 2>;
using Box = std::array<Ends, 3>; ///< of `forward`

/// (p1 - p0) x (p2 - p0), over f0 f1 f2, is the sum of these vectors, each over its f: of three rays no sum is 0.
inline std::array<glm::dvec3, 3> parts_of(const std::array<glm::dvec3, 3>& d) {
    return {glm::cross(d[1], d[2]), glm::cross(d[2], d[0]), glm::cross(d[0], d[1])};
}

/// How far rounding may turn the product, radian; nothing where that may be far, or where its square is no float.
inline std::optional<double> turned_by_rounding(const PointsOnRays& points, const Box& box) {
    const auto& d = points.ray;
    const double det = std::abs(glm::dot(d[0], glm::cross(d[1], d[2])));
    const auto longest = [&](std::size_t k) { // of the step from the pixel's point
        double most = 0.0;
        for (const double own : box[0])
            for (const double other : box[k])
                most = std::max(most, glm::length(other * d[k] - own * d[0]));
        return most;
    };
    const auto aside = [&](std::size_t i) { return box[i][1] * std::hypot(d[i].x, d[i].y); };
    const double first = longest(1), second = longest(2);
    const double error =
        of_point * ((aside(0) + aside(1)) * second + (aside(0) + aside(2)) * first) + of_cross * first * second;
    double least = 0.0; // the product's part along each ray, in turn
    for (std::size_t k = 0; k < 3; ++k)
        least = std::max(least, box[(k + 1) % 3][0] * box[(k + 2) % 3][0] * det / glm::length(d[k]));
    if (!(error < 0.7 * least && least > 1e-15 && first * second < 1e15))
        return {};
    return std::asin(error / least);
}

/// The largest cosine between a unit vector and what lies between a and b, of length 1.
inline double nearest(const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 across = glm::cross(a, b);
    const double length = glm::length(across);
    if (length > 1e-12) {
        const glm::dvec3 unit = across / length, in_plane = to - glm::dot(to, unit) * unit;
        if (glm::dot(glm::cross(a, in_plane), unit) >= 0.0 && glm::dot(glm::cross(in_plane, b), unit) >= 0.0)
            return glm::length(in_plane);
    }
    return std::max(glm::dot(to, a), glm::dot(to, b));
}

/// The same between a unit vector and what the box's corners span.
inline double nearest(const glm::dvec3& to, const PointsOnRays& points, const Box& box) {
    const auto parts = parts_of(points.ray);
    const double det = glm::dot(points.ray[0], parts[0]);
    double from = 0.0, until = HUGE_VAL; // of t: t `to` is a sum of the parts within the box
    for (std::size_t i = 0; i < 3; ++i) {
        const double share = glm::dot(to, points.ray[i]) / det;
        if (share <= 0.0) {
            until = -1.0;
            break;
        }
        from = std::max(from, 1.0 / (box[i][1] * share));
        until = std::min(until, 1.0 / (box[i][0] * share));
    }
    if (from <= until)
        return 1.0;
    std::array<glm::dvec3, 8> corners;
    for (unsigned k = 0; k < 8; ++k)
        corners[k] = glm::normalize(parts[0] / box[0][k & 1U] + parts[1] / box[1][k >> 1U & 1U] +
                                    parts[2] / box[2][k >> 2U & 1U]);
    double most = -1.0;
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = i + 1; j < 8; ++j)
            most = std::max(most, nearest(to, corners[i], corners[j]));
    return most;
}

} // namespace unit_normal_rules

/// Whether a dot product of a vector with itself may come out as 0, or as any small number: its least length is lost in
/// what rounding makes of its greatest.
inline bool may_lack_length(const std::array<Interval, 3>& vector) {
    double least = 0.0, most = 0.0;
    for (const Interval& set : vector) {
        if (set.any)
            return true;
        const Interval size = interval::magnitude(set);
        least += size.low * size.low;
        most += size.high * size.high;
    }
    return !(least > 0x1p-18 * most && least > 1e-30);
}

/// What normalize((p1 - p0) x (p2 - p0)) may be, component by component, each point being anywhere in its set. Points
/// on three rays never lie in a line with the product 0, so this has a direction where the product's own sets hold 0.
/// Nothing where that is not sure in floats.
inline std::optional<std::array<Interval, 3>> unit_normal(const PointsOnRays& points) {
    using namespace unit_normal_rules;
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        const Interval& f = points.forward[i];
        if (f.any || !(f.low > 0.0) || !(f.high >= f.low) || !std::isfinite(f.high))
            return {};
        box[i] = {f.low * (1.0 - 1e-12), f.high * (1.0 + 1e-12)};
    }
    constexpr int pieces = 8;
    const auto piece = [&](std::size_t i, int k) {
        const auto border = [&](int at) { return box[i][0] * std::pow(box[i][1] / box[i][0], at / double{pieces}); };
        return Ends{border(k), border(k + 1)};
    };
    double turned = 0.0;
    for (int k = 0; k < pieces * pieces * pieces; ++k) {
        const auto by = turned_by_rounding(
            points, {piece(0, k % pieces), piece(1, k / pieces % pieces), piece(2, k / pieces / pieces)});
        if (!by)
            return {};
        turned = std::max(turned, *by);
    }
    std::array<Interval, 3> all;
    const auto largest = [&](const glm::dvec3& along) {
        const double away = std::acos(std::clamp(nearest(along, points, box), -1.0, 1.0));
        return std::cos(std::max(away - turned, 0.0)) + of_normalize;
    };
    for (std::size_t c = 0; c < 3; ++c) {
        glm::dvec3 along(0.0);
        along[static_cast<int>(c)] = 1.0;
        all[c] = {-largest(-along), largest(along)};
    }
    return all;
}

} // namespace lockstep::fluid
