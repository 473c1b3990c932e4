#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reference/model/lifecycle/bounding_polygon.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::overdraw_test {

using namespace lockstep::lifecycle;

namespace {

constexpr int size = 64;
constexpr std::uint8_t sprites = 0, alphas = 1, overlap = 2, lit = 3;

struct Alpha {
    std::string name;
    std::vector<std::uint8_t> codes; ///< row 0 below
};

Alpha alpha_of(const std::string& name, const std::function<double(double, double)>& at) {
    Alpha made{name, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double a = at((x + 0.5) / size * 2.0 - 1.0, (y + 0.5) / size * 2.0 - 1.0);
            made.codes.push_back(static_cast<std::uint8_t>(std::clamp(a, 0.0, 1.0) * 255.0));
        }
    return made;
}

/// Seven sprites of different outlines, with soft edges.
std::vector<Alpha> all_alphas() {
    const auto ball = [](double x, double y, double cx, double cy, double r) {
        return 4.0 * (r - std::hypot(x - cx, y - cy));
    };
    return {alpha_of("disc", [&](double x, double y) { return ball(x, y, 0, 0, 0.95); }),
            alpha_of("flame",
                     [](double x, double y) {
                         const double width =
                             0.55 * std::sqrt(std::max(0.0, 1.0 - y)) * (y < -0.3 ? (1.0 + y) / 0.7 : 1);
                         return 5.0 * (width - std::abs(x));
                     }),
            alpha_of("leaf",
                     [](double x, double y) {
                         const double along = (x + y) / 1.5, across = (x - y) / 0.6;
                         return 2.0 * (1.0 - along * along - across * across);
                     }),
            alpha_of("crescent",
                     [&](double x, double y) { return std::min(ball(x, y, 0, 0, 0.9), -ball(x, y, 0.5, 0.1, 0.8)); }),
            alpha_of("streak", [](double x, double y) { return 6.0 * (0.12 - std::abs(x - 0.8 * y)) * (1.0 - y * y); }),
            alpha_of("puff",
                     [&](double x, double y) {
                         return std::max(
                             {ball(x, y, -0.3, -0.2, 0.5), ball(x, y, 0.35, -0.1, 0.45), ball(x, y, 0.0, 0.35, 0.4)});
                     }),
            alpha_of("star", [](double x, double y) {
                const double turn = std::atan2(x, y) * 5.0 / 6.283185307179586;
                const double edge = 0.38 + 0.55 * std::abs(turn - std::floor(turn + 0.5)) * 2.0;
                return 5.0 * (edge - std::hypot(x, y));
            })};
}

Field floats(const char* name, int components = 1) { return {.name = name, .components = components}; }

const Schema& drawing_of_sprites() {
    const auto image = [](const char* name) {
        return Resource{.name = name,
                        .item = "texel",
                        .title = "the texels",
                        .fields = {floats(name)},
                        .dimensions = 2,
                        .format = "r32f"};
    };
    static const Schema all = checked({"overdraw",
                                       {{.name = "sprites",
                                         .item = "sprite",
                                         .title = "the sprites",
                                         .fields = {floats("place", 2), floats("length")}},
                                        image("alphas"),
                                        image("overlap"),
                                        image("lit")}});
    return all;
}

/// Never run: what is counted is what GL draws.
struct Nothing {
    template <class R> auto operator()(R&, const PassInput&, std::size_t) const {
        ItemWords<R> words;
        words.add(typename R::Real(0.0F));
        return words;
    }
};

/// As triangles, a fan, in shares of the sprite's side.
std::string triangles_of(const std::vector<glm::dvec2>& polygon) {
    std::string text;
    for (std::size_t c = 2; c < polygon.size(); ++c)
        for (const std::size_t corner : {std::size_t{0}, c - 1, c})
            text += fmt::format("{}vec2({:.9}, {:.9})", text.empty() ? "" : ", ", polygon[corner].x / size,
                                polygon[corner].y / size);
    return fmt::format("const vec2 triangles[{0}] = vec2[{0}]({1});\n", 3 * (polygon.size() - 2), text);
}

struct Drawn {
    double fragments = 0.0, lit = 0.0;
};

/// 300 sprites of 16 to 200 pixels in 1,024 x 1,024, each fragment counted by adding 1.
Drawn drawn(const Alpha& alpha, const std::vector<glm::dvec2>& polygon) {
    constexpr std::size_t count = 300, side = 1024;
    const TemporaryFolder folder;
    folder.write("count.vert", R"(#version 430 core
in vec2 a_Place;
in float a_Length;
out vec2 at;
#include "triangles.glsl"
void main() {
    at = triangles[gl_VertexID];
    gl_Position = vec4((a_Place + at * a_Length) / 512.0 - 1.0, 0.0, 1.0);
}
)");
    folder.write("count.frag", R"(#version 430 core
in vec2 at;
out float o_Value;
uniform sampler2D u_AlphasBefore;
void main() {
    ivec2 texel = ivec2(floor(at * 64.0));
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(64)));
    float alpha = inside ? texelFetch(u_AlphasBefore, texel, 0).x : 0.0;
#ifdef LIT
    o_Value = alpha > 0.0 ? 1.0 : 0.0;
#else
    o_Value = 1.0 + 0.0 * alpha;
#endif
}
)");
    const Extent image{side, side}, of_alphas{size, size};
    System system{.name = "overdraw",
                  .schema = drawing_of_sprites(),
                  .passes = {},
                  .mistakes = {},
                  .start = {drawing_of_sprites(), {{count}, of_alphas, image, image}},
                  .settings = {}};
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<float>(random() % 100'000) / 100'000.0F; };
    for (std::size_t i = 0; i < count; ++i) {
        const float length = 16.0F + 184.0F * share() * share();
        system.start.set({sprites, 0}, i, glm::vec2(60.0F + 700.0F * share(), 60.0F + 700.0F * share()));
        system.start.set({sprites, 1}, i, length);
    }
    for (std::size_t t = 0; t < alpha.codes.size(); ++t)
        system.start.set({alphas, 0}, t, static_cast<float>(alpha.codes[t]) / 255.0F);
    std::vector<GlPass> passes;
    for (const std::uint8_t made : {overlap, lit}) {
        system.passes.push_back(item_pass({.name = "count", .resource = made}, Nothing{}));
        GlPass pass{.name = "count", .resource = made};
        pass.texts = {{"triangles.glsl", triangles_of(polygon)}};
        if (made == lit)
            pass.defines = {{"LIT", "1"}};
        pass.draw = GlDraw{.buffer = sprites,
                           .primitive = GlDraw::Primitive::triangles,
                           .blend = GlDraw::Blend::added,
                           .vertices = 3 * (polygon.size() - 2)};
        passes.push_back(std::move(pass));
    }
    GlSystemSide gpu(gl(), system, std::move(passes), folder.path().string());
    gpu.upload(system.start.view());
    gpu.step(0, 0);
    gpu.step(1, 0);
    SystemState state = system.start;
    gpu.read(state);
    Drawn sum;
    for (std::size_t t = 0; t < side * side; ++t) {
        sum.fragments += double{state.view().real({overlap, 0}, t)};
        sum.lit += double{state.view().real({lit, 0}, t)};
    }
    return sum;
}

const std::vector<glm::dvec2> quad{{0, 0}, {size, 0}, {size, size}, {0, size}};

std::vector<glm::dvec2> polygon_of(const Alpha& alpha, std::size_t k, HullPoints points = HullPoints::corners) {
    return sprite_polygon(convex_hull(outermost(alpha.codes, size, 0, points)), k);
}

} // namespace

TEST_CASE("overdraw: the bounding polygon saves the fragments that its area says, and cuts none that is lit") {
    if (!gl())
        return skip(gl().missing());
    std::string table = "sprite      lit texels   k   area saved   fragments of quad   of k-gon   saved\n";
    for (const Alpha& alpha : all_alphas()) {
        const Drawn whole = drawn(alpha, quad);
        REQUIRE(whole.lit > 1000.0);
        for (const std::size_t k : {4, 6, 8}) {
            const auto polygon = polygon_of(alpha, k);
            const Drawn fitted = drawn(alpha, polygon);
            const double by_area = 1.0 - area(polygon) / (size * size),
                         saved = 1.0 - fitted.fragments / whole.fragments;
            table += fmt::format("{:10} {:11} {:3} {:11.1f}% {:19.0f} {:10.0f} {:6.1f}%\n", alpha.name,
                                 std::count_if(alpha.codes.begin(), alpha.codes.end(), [](int a) { return a > 0; }), k,
                                 100.0 * by_area, whole.fragments, fitted.fragments, 100.0 * saved);
            INFO(alpha.name << ", k " << k);
            CHECK(saved == Approx(by_area).margin(0.01));
            // A fragment on an edge between two texels may fall on either side as its place is interpolated.
            CHECK(std::abs(fitted.lit - whole.lit) <= whole.lit * 1e-4);
        }
    }
    if (std::getenv("LOCKSTEP_SHOW_TABLE") != nullptr)
        std::cout << table;
}

TEST_CASE("overdraw: the polygon of the texels' centres cuts fragments that are lit") {
    if (!gl())
        return skip(gl().missing());
    const Alpha disc = all_alphas().front();
    const double whole = drawn(disc, quad).lit;
    CHECK(drawn(disc, polygon_of(disc, 8, HullPoints::centres)).lit < whole * 0.99);
}

} // namespace lockstep::test::overdraw_test
