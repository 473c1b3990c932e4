#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/snap.hpp"
#include "reference/model/random.hpp"
#include "reference/model/window_accuracy.hpp"

namespace lockstep::probing {
namespace {

constexpr int viewport_side = 500; // not a power of two: products with half of it round

/// What a vertex gives, and the driver's own 1 / w.
struct Projected {
    float clip, w, driver_reciprocal;
};

struct Transform {
    const char* name;
    double (*window)(const Projected& p, float scale, float offset);
};

double rounded(float x) { return static_cast<double>(x); }

double not_rounded(const Projected& p, float s, float o) {
    return double{p.clip} / double{p.w} * double{s} + double{o};
}

// clang-format off
constexpr Transform transforms[] = {
    {"(clip*(1/w))*scale + offset", [](const Projected& p, float s, float o) {
        return rounded((p.clip * (1.0F / p.w)) * s + o); }},
    {"fma(clip*(1/w), scale, offset)", [](const Projected& p, float s, float o) {
        return rounded(std::fma(p.clip * (1.0F / p.w), s, o)); }},
    {"(clip/w)*scale + offset", [](const Projected& p, float s, float o) { return rounded((p.clip / p.w) * s + o); }},
    {"fma(clip/w, scale, offset)", [](const Projected& p, float s, float o) {
        return rounded(std::fma(p.clip / p.w, s, o)); }},
    {"(clip*r)*scale + offset, r the driver's 1/w", [](const Projected& p, float s, float o) {
        return rounded((p.clip * p.driver_reciprocal) * s + o); }},
    {"fma(clip*r, scale, offset)", [](const Projected& p, float s, float o) {
        return rounded(std::fma(p.clip * p.driver_reciprocal, s, o)); }},
    {"(clip*scale)*(1/w) + offset", [](const Projected& p, float s, float o) {
        return rounded((p.clip * s) * (1.0F / p.w) + o); }},
    {"fma(clip*scale, 1/w, offset)", [](const Projected& p, float s, float o) {
        return rounded(std::fma(p.clip * s, 1.0F / p.w, o)); }},
    {"fma(clip*scale, r, offset)", [](const Projected& p, float s, float o) {
        return rounded(std::fma(p.clip * s, p.driver_reciprocal, o)); }},
    {"rounded once", [](const Projected& p, float s, float o) {
        return rounded(static_cast<float>(not_rounded(p, s, o))); }},
    {"not rounded", not_rounded},
};
// clang-format on

/// An input on which the transforms do not all lead to the same pixel.
struct Discriminating {
    int column, row; ///< of the pixel in question
    Projected x;
};

/// Whether a window coordinate leads to pixel `column` being covered; it changes at `change` pixels from its left
/// side.
struct Question {
    double change;
    std::function<bool(int column, double window)> covered;
};

/// Floats round the place where the answer changes, at random w, some a column and row.
std::vector<Discriminating> search(const Question& question) {
    std::vector<Discriminating> found;
    Random random(41, 0);
    const float half = viewport_side / 2.0F;
    for (int row = 0; row < viewport_side; row += 2)
        for (int column = 4; column < viewport_side - 4; column += 12)
            for (int attempt = 0; attempt < 8; ++attempt) {
                const auto w = static_cast<float>(1.0 + 7.0 * random.unit());
                const double ndc = (column + question.change - viewport_side / 2.0) / (viewport_side / 2.0);
                const float nearby = 1.0F + static_cast<float>(random.symmetric()) * 0x1p-22F;
                const Projected x{static_cast<float>(ndc * static_cast<double>(w)) * nearby, w, 1.0F / w};
                const auto answer = [&](const Transform& t) {
                    return question.covered(column, t.window(x, half, half));
                };
                const bool first = answer(transforms[0]);
                if (std::all_of(std::begin(transforms), std::end(transforms),
                                [&](const Transform& t) { return answer(t) == first; }))
                    continue;
                found.push_back({column, row, x});
                break;
            }
    return found;
}

float to_clip(double window, float w) {
    return static_cast<float>((window / (viewport_side / 2.0) - 1.0) * static_cast<double>(w));
}

/// Places further from the border than glsl_window_accuracy explains, by up to 16 times.
std::vector<Discriminating> search_beyond(const Question& question) {
    std::vector<Discriminating> found;
    Random random(43, 0);
    constexpr double half = viewport_side / 2.0;
    for (int row = 0; row < viewport_side; row += 2)
        for (int column = 4; column < viewport_side - 4; column += 12) {
            const auto w = static_cast<float>(1.0 + 7.0 * random.unit());
            const double border = column + question.change;
            const double distance = glsl_window_accuracy.error(border, half) * std::exp2(4.0 * random.unit()) *
                                    (random.unit() < 0.5 ? 1 : -1);
            const Projected x{to_clip(border + distance, w), w, 1.0F / w};
            const double exact = not_rounded(x, half, half);
            if (std::abs(exact - border) > glsl_window_accuracy.error(exact, half))
                found.push_back({column, row, x});
        }
    return found;
}

void take_reciprocals(const DriverArithmetic& gl, std::vector<Discriminating>& inputs) {
    Floats w;
    for (const Discriminating& input : inputs)
        w.push_back(input.x.w);
    const Floats reciprocals = gl.reciprocal(w);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        inputs[i].x.driver_reciprocal = reciprocals[i];
}

std::vector<RasterVertex> points(const std::vector<Discriminating>& inputs) {
    std::vector<RasterVertex> vertices;
    for (const auto& [column, row, x] : inputs)
        vertices.push_back({{x.clip, to_clip(row + 0.5, x.w), 0.0F, x.w}, static_cast<float>(vertices.size())});
    return vertices;
}

/// Each with an upright left side.
std::vector<RasterVertex> triangles(const std::vector<Discriminating>& inputs) {
    std::vector<RasterVertex> vertices;
    for (const auto& [column, row, x] : inputs) {
        const auto id = static_cast<float>(vertices.size() / 3);
        vertices.push_back({{x.clip, to_clip(row + 0.1, x.w), 0.0F, x.w}, id});
        vertices.push_back({{to_clip(column + 2.25, x.w), to_clip(row + 0.5, x.w), 0.0F, x.w}, id});
        vertices.push_back({{x.clip, to_clip(row + 0.9, x.w), 0.0F, x.w}, id});
    }
    return vertices;
}

/// For each input, whether its primitive covers the pixel in question.
std::vector<int> draw(Primitive primitive, bool geometry, const std::vector<Discriminating>& inputs,
                      const IdImage& image) {
    image.clear();
    RasterStage(primitive, geometry).draw(primitive == Primitive::points ? points(inputs) : triangles(inputs));
    const Floats ids = image.ids();
    std::vector<int> covered;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto pixel = static_cast<std::size_t>(inputs[i].row * viewport_side + inputs[i].column);
        covered.push_back(ids[pixel] == static_cast<float>(i) ? 1 : 0);
    }
    return covered;
}

std::string name_of(Primitive primitive) { return primitive == Primitive::points ? "points" : "triangles"; }

void measure(Primitive primitive, const DriverArithmetic& gl, const IdImage& image, const Question& question,
             Rows& rows) {
    auto inputs = search(question);
    take_reciprocals(gl, inputs);
    std::vector<Prediction<int>> predictions;
    for (const Transform& transform : transforms) {
        std::vector<int> values;
        for (const auto& [column, row, x] : inputs)
            values.push_back(
                question.covered(column, transform.window(x, viewport_side / 2.0F, viewport_side / 2.0F)) ? 1 : 0);
        predictions.push_back({transform.name, std::move(values)});
    }
    for (const bool geometry : {true, false})
        rows.push_back(judge(name_of(primitive) + ": viewport" + (geometry ? "" : ", no geometry stage"),
                             draw(primitive, geometry, inputs, image), predictions));
}

/// Whether window coordinates err by no more than a shader's own would, with a geometry stage and without.
void measure_accuracy(Primitive primitive, const IdImage& image, const Question& question, Rows& rows) {
    const auto inputs = search_beyond(question);
    std::vector<int> measured, expected;
    for (const bool geometry : {true, false}) {
        const std::vector<int> covered = draw(primitive, geometry, inputs, image);
        measured.insert(measured.end(), covered.begin(), covered.end());
        for (const auto& [column, row, x] : inputs)
            expected.push_back(
                question.covered(column, not_rounded(x, viewport_side / 2.0F, viewport_side / 2.0F)) ? 1 : 0);
    }
    rows.push_back(judge(name_of(primitive) + ": window accuracy", measured, {{"as GLSL's", expected}}));
}

bool found(const Rows& rows, std::string_view name, std::string_view finding) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const ProbeRow& row) { return row.name == name && row.finding == finding; });
}

} // namespace

void measure_viewport(const DriverArithmetic& plain, Rows& rows) {
    const IdImage image(viewport_side, viewport_side);
    gl::Disable(GL_DEPTH_TEST);

    const Snap point_snap = found_snap(rows, "points");
    const bool to_lower = !found(rows, "points: edge in x", "upper pixel");
    const double point_unit = std::ldexp(1.0, -point_snap.bits);
    const Question point{to_lower ? point_unit / 2 : -point_unit / 2, [&](int column, double window) {
                             return point_pixel(window, point_snap, to_lower) == column;
                         }};
    measure(Primitive::points, plain, image, point, rows);

    const Snap corner_snap = found_snap(rows, "triangles");
    const bool left_in = !found(rows, "triangles: left side", "out");
    const double corner_unit = std::ldexp(1.0, -corner_snap.bits);
    const Question corner{left_in ? 0.5 + corner_unit / 2 : 0.5 - corner_unit / 2, [&](int column, double window) {
                              const std::int64_t centre = std::int64_t{column} << corner_snap.bits;
                              return corner_snap(window) < centre + (left_in ? 1 : 0);
                          }};
    measure(Primitive::triangles, plain, image, corner, rows);
    measure_accuracy(Primitive::points, image, point, rows);
    measure_accuracy(Primitive::triangles, image, corner, rows);
}

} // namespace lockstep::probing
