#include "gpu/probe/snap.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {
namespace {

constexpr int snap_side = 512; // a power of two: its viewport transform rounds nothing of what is drawn here
constexpr int fewest_bits = 4;
constexpr int most_bits = 12;

using Pixels = std::vector<int>;

float to_clip(double window) { return static_cast<float>(window / (snap_side / 2) - 1.0); }

/// The best prediction for each number of bits, over all roundings, then the roundings for the best number of bits.
template <class Predict>
void judge_snap(const std::string& primitive, const Pixels& measured, const Predict& predict, Rows& rows) {
    const auto with_bits = [&](int bits) {
        std::vector<Prediction<int>> predictions;
        for (const SnapRounding& rounding : snap_roundings())
            predictions.push_back({std::string(rounding.name), predict(Snap{bits, rounding})});
        return predictions;
    };
    std::vector<Prediction<int>> of_bits;
    std::vector<ProbeRow> of_roundings;
    for (int bits = fewest_bits; bits <= most_bits; ++bits) {
        const auto predictions = with_bits(bits);
        of_roundings.push_back(judge(primitive + ": snap", measured, predictions));
        const auto& candidates = of_roundings.back().candidates;
        const auto best =
            std::max_element(candidates.begin(), candidates.end(),
                             [](const ProbeCandidate& a, const ProbeCandidate& b) { return a.matched < b.matched; });
        of_bits.push_back(
            {std::to_string(bits), predictions[static_cast<std::size_t>(best - candidates.begin())].values});
    }
    // Nearest rounding explains before rounding down does, whatever the number of bits.
    const auto rank = [](const ProbeRow& row) {
        const bool down = row.finding == snap_roundings().back().name;
        return std::pair(row.matched, down ? 0 : 1);
    };
    const auto best = std::max_element(of_roundings.begin(), of_roundings.end(),
                                       [&](const ProbeRow& a, const ProbeRow& b) { return rank(a) < rank(b); });
    std::rotate(of_bits.begin(), of_bits.begin() + (best - of_roundings.begin()),
                of_bits.begin() + (best - of_roundings.begin()) + 1);
    rows.push_back(judge(primitive + ": sub-pixel bits", measured, of_bits));
    rows.push_back(*best);
}

/// Points in steps of 2^-12 pixels across pixel edges, one image row a step; `axis` 0: across x, 1: across y.
struct PointSweep {
    struct Point {
        int edge;
        double window;
    };
    std::vector<Point> points;
    Pixels pixels; ///< that each covers, -1: none, -2: several
};

PointSweep sweep_points(const RasterStage& stage, const IdImage& image, int axis) {
    PointSweep sweep;
    std::vector<RasterVertex> vertices;
    for (const int edge : {0, 2, 5, 100, 131, 255, 257, 300, 401, 511})
        for (int row = 0; row < snap_side; ++row) {
            const double window = edge + (row - snap_side / 2) * 0x1p-12;
            if (window < 0.0)
                continue;
            glm::vec4 clip(0.0F, 0.0F, 0.0F, 1.0F);
            clip[axis] = to_clip(window);
            clip[1 - axis] = to_clip(row + 0.5);
            vertices.push_back({clip, static_cast<float>(sweep.points.size())});
            sweep.points.push_back({edge, window});
        }
    image.clear();
    stage.draw(vertices);
    const Floats ids = image.ids();
    sweep.pixels.assign(sweep.points.size(), -1);
    for (int i = 0; i < snap_side * snap_side; ++i)
        if (const float id = ids[static_cast<std::size_t>(i)]; id >= 0.0F) {
            int& pixel = sweep.pixels[static_cast<std::size_t>(id)];
            pixel = pixel == -1 ? (axis == 0 ? i % snap_side : i / snap_side) : -2;
        }
    return sweep;
}

void measure_points(Rows& rows) {
    const RasterStage stage(Primitive::points, true);
    const IdImage image(snap_side, snap_side);
    gl::Disable(GL_DEPTH_TEST);
    PointSweep across_x = sweep_points(stage, image, 0);
    for (const int axis : {0, 1}) {
        const PointSweep sweep = axis == 0 ? across_x : sweep_points(stage, image, 1);
        Pixels measured, lower, upper;
        for (std::size_t i = 0; i < sweep.points.size(); ++i) {
            const auto& [edge, window] = sweep.points[i];
            if (window != edge)
                continue;
            measured.push_back(sweep.pixels[i]);
            lower.push_back(edge - 1);
            upper.push_back(edge);
        }
        rows.push_back(judge(axis == 0 ? "points: edge in x" : "points: edge in y", measured,
                             {{"lower pixel", lower}, {"upper pixel", upper}}));
    }
    const bool to_lower = rows.at(rows.size() - 2).finding != "upper pixel";
    judge_snap(
        "points", across_x.pixels,
        [&](const Snap& snap) {
            Pixels pixels;
            for (const auto& point : across_x.points)
                pixels.push_back(point_pixel(point.window, snap, to_lower));
            return pixels;
        },
        rows);
}

using Corner = glm::dvec2; ///< window coordinates

void append(std::vector<RasterVertex>& vertices, const std::array<Corner, 3>& corners, int id) {
    for (const Corner& corner : corners)
        vertices.push_back({{to_clip(corner.x), to_clip(corner.y), 0.0F, 1.0F}, static_cast<float>(id)});
}

/// One small triangle a cell with a side through a pixel's centre, and whether it covers that pixel.
void measure_fill_rule(const RasterStage& stage, const IdImage& image, Rows& rows) {
    struct Side {
        const char* name;
        std::array<Corner, 3> corners; ///< from the pixel's lower left corner
    };
    const Side sides[] = {
        {"triangles: left side", {{{0.5, 0.0}, {2.25, 0.5}, {0.5, 1.0}}}},
        {"triangles: right side", {{{0.5, 0.0}, {0.5, 1.0}, {-1.25, 0.5}}}},
        {"triangles: lower side", {{{0.0, 0.5}, {1.0, 0.5}, {0.5, 2.25}}}},
        {"triangles: upper side", {{{0.0, 0.5}, {0.5, -1.25}, {1.0, 0.5}}}},
    };
    constexpr int cell = 32;
    for (const auto& [name, corners] : sides) {
        std::vector<RasterVertex> vertices;
        std::vector<int> pixels;
        for (int y = 3; y < snap_side; y += cell)
            for (int x = 5; x < snap_side; x += cell) {
                std::array<Corner, 3> moved = corners;
                for (Corner& corner : moved)
                    corner += Corner(x, y);
                append(vertices, moved, static_cast<int>(pixels.size()));
                pixels.push_back(y * snap_side + x);
            }
        image.clear();
        stage.draw(vertices);
        const Floats ids = image.ids();
        Pixels covered;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            covered.push_back(ids[static_cast<std::size_t>(pixels[i])] == static_cast<float>(i) ? 1 : 0);
        rows.push_back(judge(name, covered, {{"in", Pixels(covered.size(), 1)}, {"out", Pixels(covered.size(), 0)}}));
    }
}

/// Whether a triangle, counterclockwise and y up, covers the centre of pixel (x, y).
bool covers(const std::array<std::array<std::int64_t, 2>, 3>& corners, int x, int y, int bits, bool left_in,
            bool lower_in) {
    const std::int64_t px = std::int64_t{x} << bits;
    const std::int64_t py = std::int64_t{y} << bits;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& a = corners[i];
        const auto& b = corners[(i + 1) % 3];
        const std::int64_t dx = b[0] - a[0];
        const std::int64_t dy = b[1] - a[1];
        const std::int64_t edge = dx * (py - a[1]) - dy * (px - a[0]);
        const bool owns = dy == 0 ? (dx > 0) == lower_in : (dy < 0) == left_in;
        if (edge < 0 || (edge == 0 && !owns))
            return false;
    }
    return true;
}

/// Steep sides, each a little further right than the last: where they pass a column's centres tells their corners'
/// place to a fraction of any grid.
void measure_triangle_snap(const RasterStage& stage, const IdImage& image, bool left_in, bool lower_in, Rows& rows) {
    constexpr int spacing = 4;
    std::vector<std::array<Corner, 3>> triangles;
    std::vector<RasterVertex> vertices;
    for (int column = 1; column < snap_side; column += spacing) {
        const double x = column + 0.25 + static_cast<double>(triangles.size()) * 0x1p-12;
        triangles.push_back({{{x, 0.0}, {column + 2.25, snap_side / 2}, {x + 0.5, snap_side}}});
        append(vertices, triangles.back(), static_cast<int>(triangles.size()) - 1);
    }
    image.clear();
    stage.draw(vertices);
    const Floats ids = image.ids();
    const auto for_each_pixel = [&](auto visit) {
        Pixels pixels;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (int y = 0; y < snap_side; ++y)
                pixels.push_back(visit(t, static_cast<int>(t) * spacing + 1, y) ? 1 : 0);
        return pixels;
    };
    const Pixels measured = for_each_pixel([&](std::size_t t, int x, int y) {
        return ids[static_cast<std::size_t>(y * snap_side + x)] == static_cast<float>(t);
    });
    judge_snap(
        "triangles", measured,
        [&](const Snap& snap) {
            std::vector<std::array<std::array<std::int64_t, 2>, 3>> snapped;
            for (const auto& t : triangles)
                snapped.push_back(
                    {{{snap(t[0].x), snap(t[0].y)}, {snap(t[1].x), snap(t[1].y)}, {snap(t[2].x), snap(t[2].y)}}});
            return for_each_pixel(
                [&](std::size_t t, int x, int y) { return covers(snapped[t], x, y, snap.bits, left_in, lower_in); });
        },
        rows);
}

void measure_triangles(Rows& rows) {
    const RasterStage stage(Primitive::triangles, true);
    const IdImage image(snap_side, snap_side);
    gl::Disable(GL_DEPTH_TEST);
    const std::size_t first = rows.size();
    measure_fill_rule(stage, image, rows);
    measure_triangle_snap(stage, image, rows[first].finding != "out", rows[first + 2].finding != "out", rows);
}

const ProbeRow& named(const Rows& rows, std::string_view name) {
    return *std::find_if(rows.begin(), rows.end(), [&](const ProbeRow& row) { return row.name == name; });
}

} // namespace

const std::array<SnapRounding, 4>& snap_roundings() {
    static const std::array<SnapRounding, 4> roundings{{
        {"half to even", [](double x) { return std::nearbyint(x); }},
        {"half away from zero", [](double x) { return std::round(x); }},
        {"half up", [](double x) { return std::floor(x + 0.5); }},
        {"down", [](double x) { return std::floor(x); }},
    }};
    return roundings;
}

int point_pixel(double window, const Snap& snap, bool edge_to_lower) {
    const std::int64_t half = std::int64_t{1} << (snap.bits - 1);
    return static_cast<int>((snap(window) + half - (edge_to_lower ? 1 : 0)) >> snap.bits);
}

Snap found_snap(const Rows& rows, std::string_view primitive) {
    Snap snap{8, snap_roundings()[1]};
    const ProbeRow& bits = named(rows, fmt::format("{}: sub-pixel bits", primitive));
    const ProbeRow& rounding = named(rows, fmt::format("{}: snap", primitive));
    if (bits.finding != none_known)
        snap.bits = std::stoi(bits.finding);
    for (const SnapRounding& candidate : snap_roundings())
        if (candidate.name == rounding.finding)
            snap.rounding = candidate;
    return snap;
}

void measure_snapping(Rows& rows) {
    measure_points(rows);
    measure_triangles(rows);
}

} // namespace lockstep::probing
