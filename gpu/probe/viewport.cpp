#include <algorithm>
#include <cmath>
#include <string>

#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/snap.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int side = 500; // not a power of two: products with half of it round

struct Transform {
    const char* name;
    float (*window)(float clip, float w, float scale, float offset);
};

// clang-format off
constexpr Transform transforms[] = {
    {"(clip*(1/w))*scale + offset", [](float c, float w, float s, float o) { return (c * (1.0F / w)) * s + o; }},
    {"fma(clip*(1/w), scale, offset)", [](float c, float w, float s, float o) { return std::fma(c * (1.0F / w), s, o); }},
    {"(clip/w)*scale + offset", [](float c, float w, float s, float o) { return (c / w) * s + o; }},
    {"fma(clip/w, scale, offset)", [](float c, float w, float s, float o) { return std::fma(c / w, s, o); }},
    {"(clip*scale)*(1/w) + offset", [](float c, float w, float s, float o) { return (c * s) * (1.0F / w) + o; }},
    {"fma(clip*scale, 1/w, offset)", [](float c, float w, float s, float o) { return std::fma(c * s, 1.0F / w, o); }},
    {"rounded once", [](float c, float w, float s, float o) {
        return static_cast<float>(double{c} / double{w} * double{s} + double{o}); }},
};
// clang-format on

/// An input on which the transforms do not all lead to the same pixel.
struct Discriminating {
    int column, row; ///< of the pixel in question
    float clip, w;
};

/// One for every row of every other column, as far as random w and the floats round the place where the pixel changes
/// give one. `decide` is the answer a window coordinate leads to; `place` within the pixel is where it changes.
template <class Decide> std::vector<Discriminating> search(double place, const Decide& decide) {
    std::vector<Discriminating> found;
    Random random(41, 0);
    const float half = side / 2.0F;
    for (int row = 0; row < side; row += 2)
        for (int column = 4; column < side - 4; column += 12)
            for (int attempt = 0; attempt < 8; ++attempt) {
                const auto w = static_cast<float>(1.0 + 7.0 * random.unit());
                const double ndc = (column + place - side / 2.0) / (side / 2.0);
                float clip = static_cast<float>(ndc * static_cast<double>(w));
                clip *= 1.0F + static_cast<float>(random.symmetric()) * 0x1p-22F;
                const auto answer = [&](const Transform& t) {
                    return decide(column, static_cast<double>(t.window(clip, w, half, half)));
                };
                const int first = answer(transforms[0]);
                if (std::all_of(std::begin(transforms), std::end(transforms),
                                [&](const Transform& t) { return answer(t) == first; }))
                    continue;
                found.push_back({column, row, clip, w});
                break;
            }
    return found;
}

float to_clip(double window, float w) {
    return static_cast<float>((window / (side / 2.0) - 1.0) * static_cast<double>(w));
}

template <class Decide> void judge_transforms(const std::string& name, const std::vector<Discriminating>& inputs,
                                              const std::vector<int>& measured, const Decide& decide, Rows& rows) {
    std::vector<Prediction<int>> predictions;
    for (const Transform& transform : transforms) {
        std::vector<int> values;
        for (const Discriminating& input : inputs)
            values.push_back(decide(
                input.column, static_cast<double>(transform.window(input.clip, input.w, side / 2.0F, side / 2.0F))));
        predictions.push_back({transform.name, std::move(values)});
    }
    rows.push_back(judge(name, measured, predictions));
}

const char* suffix(bool geometry) { return geometry ? "" : ", no geometry stage"; }

/// A point by the lower edge of its pixel: is it that pixel?
void measure_points(const IdImage& image, const Snap& snap, bool to_lower, Rows& rows) {
    const auto decide = [&](int column, double window) {
        return point_pixel(window, snap, to_lower) == column ? 1 : 0;
    };
    const double half_unit = std::ldexp(0.5, -snap.bits);
    const auto inputs = search(to_lower ? half_unit : -half_unit, decide);
    std::vector<RasterVertex> vertices;
    for (std::size_t i = 0; i < inputs.size(); ++i)
        vertices.push_back(
            {{inputs[i].clip, to_clip(inputs[i].row + 0.5, inputs[i].w), 0.0F, inputs[i].w}, static_cast<float>(i)});
    for (const bool geometry : {true, false}) {
        image.clear();
        RasterStage(Primitive::points, geometry).draw(vertices);
        const Floats ids = image.ids();
        std::vector<int> measured;
        for (std::size_t i = 0; i < inputs.size(); ++i)
            measured.push_back(
                ids[static_cast<std::size_t>(inputs[i].row * side + inputs[i].column)] == static_cast<float>(i) ? 1
                                                                                                                : 0);
        judge_transforms(std::string("points: viewport") + suffix(geometry), inputs, measured, decide, rows);
    }
}

/// A triangle with an upright left side by the centre of a pixel: does it cover that pixel?
void measure_triangles(const IdImage& image, const Snap& snap, bool left_in, Rows& rows) {
    const auto decide = [&](int column, double window) {
        const std::int64_t centre = std::int64_t{column} << snap.bits;
        return snap(window) < centre + (left_in ? 1 : 0) ? 1 : 0;
    };
    const double half_unit = std::ldexp(0.5, -snap.bits);
    const auto inputs = search(left_in ? 0.5 + half_unit : 0.5 - half_unit, decide);
    std::vector<RasterVertex> vertices;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto& [column, row, clip, w] = inputs[i];
        const auto id = static_cast<float>(i);
        vertices.push_back({{clip, to_clip(row + 0.1, w), 0.0F, w}, id});
        vertices.push_back({{to_clip(column + 2.25, w), to_clip(row + 0.5, w), 0.0F, w}, id});
        vertices.push_back({{clip, to_clip(row + 0.9, w), 0.0F, w}, id});
    }
    for (const bool geometry : {true, false}) {
        image.clear();
        RasterStage(Primitive::triangles, geometry).draw(vertices);
        const Floats ids = image.ids();
        std::vector<int> measured;
        for (std::size_t i = 0; i < inputs.size(); ++i)
            measured.push_back(
                ids[static_cast<std::size_t>(inputs[i].row * side + inputs[i].column)] == static_cast<float>(i) ? 1
                                                                                                                : 0);
        judge_transforms(std::string("triangles: viewport") + suffix(geometry), inputs, measured, decide, rows);
    }
}

bool found(const Rows& rows, std::string_view name, std::string_view finding) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const ProbeRow& row) { return row.name == name && row.finding == finding; });
}

} // namespace

void measure_viewport(Rows& rows) {
    const IdImage image(side, side);
    gl::Disable(GL_DEPTH_TEST);
    measure_points(image, found_snap(rows, "points"), !found(rows, "points: edge in x", "upper pixel"), rows);
    measure_triangles(image, found_snap(rows, "triangles"), !found(rows, "triangles: left side", "out"), rows);
}

} // namespace lockstep::probing
