#include "reference/collision/render/legal_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <catch2/catch.hpp>

#include "crosscheck/collision/judge/render_judge.hpp"

namespace lockstep::test::legal_pixels_test {
namespace {

constexpr KnownOperations glsl_alone{};

/// Camera at z = 3 looking down -z, 64 pixels square.
FrameParams view() {
    FrameParams params;
    params.render_width = params.render_height = 64;
    params.render_view = view_matrix(Camera{});
    params.render_projection = projection_matrix(Camera{}, 1.0F);
    params.constants.billboard_radius = 0.2F;
    return params;
}

Particles at(const std::vector<glm::vec3>& positions) {
    Particles particles;
    particles.resize(positions.size());
    particles.position = positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        particles.speed[i] = static_cast<float>(i);
    return particles;
}

LegalPixel legal_at(const Particles& particles, const Mesh& mesh, int x, int y,
                    const KnownOperations& known = glsl_alone) {
    const FrameParams params = view();
    const std::size_t pixel = static_cast<std::size_t>(y * params.render_width + x);
    return legal_pixels({particles, mesh, params}, Profile{}, known, std::span(&pixel, 1)).front();
}

} // namespace

TEST_CASE("legal pixels: what the reference draws is legal in every pixel, with few codes to choose from") {
    const Particles particles = at({{0, 0, 0}, {0.1F, 0.05F, 0.1F}, {-0.5F, 0.3F, 1.0F}});
    const Mesh mesh{{{-1, -1, -0.5F}, {1, -1, 0}, {0, 1, 0.1F}}, {0, 1, 2}};
    const FrameParams params = view();
    const ColorImage image = render_pass(particles, mesh, params, Profile{});
    std::vector<std::size_t> all(image.texels.size());
    std::iota(all.begin(), all.end(), 0U);
    int largest = 0;
    for (const KnownOperations& known : {glsl_alone, KnownOperations::all(), KnownOperations{.sums = false}}) {
        const auto legal = legal_pixels({particles, mesh, params}, Profile{}, known, all);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& candidates = legal[i].candidates;
            INFO(i);
            REQUIRE(!candidates.empty());
            CHECK(std::any_of(candidates.begin(), candidates.end(),
                              [&](const PixelCandidate& c) { return !c.open && c.may_be(image.texels[i]); }));
            for (const PixelCandidate& c : candidates)
                largest = std::max({largest, c.high.r - c.low.r, c.high.g - c.low.g, c.high.b - c.low.b});
        }
    }
    CHECK(largest <= 2);
}

TEST_CASE("legal pixels: of two spheres at one depth either may be seen, unless equal depths are known") {
    const Particles particles = at({{0, 0, 0}, {0, 0, 0}});
    KnownOperations known = KnownOperations::all();
    known.raster.equal_depth = known.points = false;
    CHECK(legal_at(particles, {}, 32, 32, known).candidates.size() == 2);
    CHECK(legal_at(particles, {}, 32, 32, glsl_alone).candidates.size() == 2);
    CHECK(legal_at(at({{0, 0, 0}, {0, 0, 0.01F}}), {}, 32, 32).candidates.size() == 1);
}

TEST_CASE("legal pixels: a pixel inside a sphere has to show it, one outside may not") {
    const LegalPixel inside = legal_at(at({{0, 0, 0}}), {}, 32, 32);
    REQUIRE(inside.candidates.size() == 1);
    CHECK(inside.candidates[0].owner == PixelOwner{PixelOwner::Kind::particle, 0});
    CHECK(inside.candidates[0].sure);
    const LegalPixel outside = legal_at(at({{0, 0, 0}}), {}, 50, 32);
    REQUIRE(outside.candidates.size() == 1);
    CHECK(outside.candidates[0].owner == PixelOwner());
}

TEST_CASE("legal pixels: what is drawn to a pixel is told with what hides it, and the rest is what may be seen") {
    const Particles particles = at({{0, 0, 0}, {0.1F, 0.05F, 0.1F}, {-0.5F, 0.3F, 1.0F}, {0, 0, -2}});
    const Mesh mesh{{{-1, -1, -0.5F}, {1, -1, 0}, {0, 1, 0.1F}}, {0, 1, 2}};
    const FrameParams params = view();
    const RenderInputs inputs{particles, mesh, params};
    std::size_t hidden = 0;
    for (std::size_t pixel = 0; pixel < 64 * 64; pixel += 3) {
        INFO(pixel);
        std::vector<PixelOwner> seen, legal;
        for (const PixelFragment& fragment : pixel_fragments(inputs, Profile{}, glsl_alone, pixel))
            if (!fragment.hidden_by)
                seen.push_back(fragment.candidate.owner);
            else
                ++hidden;
        const LegalPixel allowed = legal_pixels(inputs, Profile{}, glsl_alone, std::span(&pixel, 1)).front();
        for (const PixelCandidate& c : allowed.candidates)
            legal.push_back(c.owner);
        CHECK(seen == legal);
    }
    CHECK(hidden > 500);
    // Particle 1 is the nearest in the middle, and hides the triangle, which hides particle 3 too.
    for (const PixelFragment& fragment : pixel_fragments(inputs, Profile{}, glsl_alone, 32 * 64 + 32))
        if (fragment.candidate.owner != PixelOwner{PixelOwner::Kind::particle, 1})
            CHECK(fragment.hidden_by == PixelOwner{PixelOwner::Kind::particle, 1});
    CHECK(pixel_fragments(inputs, Profile{}, glsl_alone, 32 * 64 + 32).size() == 5);
}

TEST_CASE("legal pixels: a rim, or a side, through the pixel's centre leaves it to rounding") {
    // Half a side of the square is 5 pixels, and the centre of the sphere a pixel's.
    FrameParams params = view();
    const float scale = params.render_projection[0][0] * 32.0F / 3.0F; // pixels a unit at z = 0
    params.constants.billboard_radius = 5.0F / scale;
    const Particles particles = at({{0.5F / scale, 0.5F / scale, 0}});
    const std::size_t pixel = 32 * 64 + 37;
    const auto legal = legal_pixels({particles, {}, params}, Profile{}, glsl_alone, std::span(&pixel, 1)).front();
    REQUIRE(legal.candidates.size() == 2);
    CHECK(legal.candidates[1].edge_margin < 0.1);
    // A side of the triangle through the middle of the image's pixel column 32.
    const Mesh mesh{{{0.5F / scale, -0.5F, 0}, {0.5F / scale, 0.5F, 0}, {0.5F, 0, 0}}, {0, 1, 2}};
    const std::size_t beside = 32 * 64 + 32;
    CHECK(legal_pixels({{}, mesh, params}, Profile{}, glsl_alone, std::span(&beside, 1)).front().candidates.size() ==
          2);
}

TEST_CASE("legal pixels: a state that is not a number leaves a particle's colour open") {
    Particles particles = at({{0, 0, 0}});
    particles.speed[0] = std::numeric_limits<float>::quiet_NaN();
    CHECK(legal_at(particles, {}, 32, 32).candidates[0].open);
}

TEST_CASE("legal pixels: arithmetic=exact leaves nothing open") {
    FrameParams params = view();
    params.switches.arithmetic = ArithmeticSwitch::exact;
    const Particles particles = at({{0, 0, 0}, {0, 0, 0}});
    const std::size_t pixel = 32 * 64 + 32;
    const auto legal = legal_pixels({particles, {}, params}, Profile{}, glsl_alone, std::span(&pixel, 1)).front();
    REQUIRE(legal.candidates.size() == 1);
    CHECK(legal.candidates[0].low == legal.candidates[0].high);
}

TEST_CASE("render judge: one code off the legal ones is divergent, one sphere missing too") {
    const Particles particles = at({{0, 0, 0}, {0.5F, 0.5F, 0}});
    const FrameParams params = view();
    ColorImage image = render_pass(particles, {}, params, Profile{});
    const RenderInputs inputs{particles, {}, params};
    CHECK(judge_render(inputs, Profile{}, glsl_alone, image).differing == 0);
    image.at(32, 32).g += 3;
    RenderVerdict verdict = judge_render(inputs, Profile{}, glsl_alone, image);
    CHECK(verdict.count(DifferenceClass::divergent) == 1);
    CHECK(verdict.causes.empty());
    REQUIRE(verdict.first);
    CHECK(verdict.first->index == 32 * 64 + 32);
    CHECK(verdict.first->owner == "particle 0");
    const ColorImage without = render_pass(at({{0, 0, 0}}), {}, params, Profile{});
    verdict = judge_render(inputs, Profile{}, glsl_alone, without);
    CHECK(verdict.count(DifferenceClass::divergent) > verdict.differing * 3 / 4);
}

TEST_CASE("render judge: a driver on a sub-pixel grid of its own is legal where no grid was measured") {
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 200; ++i)
        positions.emplace_back(0.011F * static_cast<float>(i) - 1.1F, 0.3F * std::sin(static_cast<float>(i)),
                               0.2F * std::cos(static_cast<float>(i)));
    FrameParams params = view();
    params.constants.billboard_radius = 0.05F;
    const Particles particles = at(positions);
    const Mesh mesh{{{-1, -1, -0.05F}, {1, -1, 0.05F}, {0, 1, 0.1F}}, {0, 1, 2}};
    Profile other;
    other.raster.subpixel_bits = 4;
    other.raster.vertex_snap = SnapRounding::down;
    other.raster.left_edge_in = other.raster.lower_edge_in = false;
    const RenderVerdict verdict =
        judge_render({particles, mesh, params}, Profile{}, glsl_alone, render_pass(particles, mesh, params, other));
    CHECK(verdict.count(DifferenceClass::tie) > 0);
    CHECK(verdict.count(DifferenceClass::divergent) == 0);
    KnownOperations measured = KnownOperations::all();
    CHECK(judge_render({particles, mesh, params}, Profile{}, measured, render_pass(particles, mesh, params, other))
              .count(DifferenceClass::divergent) > 0);
}

} // namespace lockstep::test::legal_pixels_test
