#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/fluid/shading.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/fluid/fluid_images.hpp"

namespace lockstep::test::oracles_test {

/// What a fluid's images have to be, found without the twins.
namespace fluid = lockstep::fluid;

namespace {

using Reading = FluidImages::Reading;
using Real = Reading::Real;
using fluid::field::depth;
using fluid::field::smooth_depth;

constexpr double fov_tangent = 0.57735026918962576; ///< of 30 degrees
constexpr double near = 0.1, far = 100.0;
constexpr double a = -(far + near) / (far - near), b = -2.0 * far * near / (far - near);
double ndc_of(double z) { return (a * z + b) / -z; }
double z_of_ndc(double ndc) { return -b / (ndc + a); }

double slope(int i, int size) { return (2.0 * i + 1.0 - size) / size * fov_tangent; }

struct FilterCase {
    const char* name;
    fluid::Filter filter;
    fluid::FilterShape shape;
    fluid::FilterConstants constants;
};
constexpr std::array<FilterCase, 8> filters{{
    {"gaussian", fluid::Filter::gaussian, fluid::FilterShape::separable_vh, fluid::FilterConstants::published},
    {"gaussian full2d", fluid::Filter::gaussian, fluid::FilterShape::full2d, fluid::FilterConstants::published},
    {"gaussian metric", fluid::Filter::gaussian, fluid::FilterShape::separable_vh, fluid::FilterConstants::metric},
    {"bilateral", fluid::Filter::bilateral, fluid::FilterShape::separable_vh, fluid::FilterConstants::published},
    {"bilateral metric", fluid::Filter::bilateral, fluid::FilterShape::separable_vh, fluid::FilterConstants::metric},
    {"bilateral full2d", fluid::Filter::bilateral, fluid::FilterShape::full2d, fluid::FilterConstants::metric},
    {"narrow range", fluid::Filter::narrow_range, fluid::FilterShape::separable_vh, fluid::FilterConstants::metric},
    {"curvature flow", fluid::Filter::curvature_flow, fluid::FilterShape::separable_vh, fluid::FilterConstants::metric},
}};

fluid::Settings with(fluid::Settings s, const FilterCase& one) {
    s.switches.filter = one.filter;
    s.switches.filter_shape = one.shape;
    s.switches.filter_constants = one.constants;
    s.filter_radius = 5;
    s.flow_iterations = 5;
    return s;
}

/// Depths of noise around a plane that faces the camera.
double noise(int x, int y) {
    Random random(11, static_cast<std::size_t>(y * 1000 + x));
    return -2.0 + 0.005 * random.symmetric();
}

struct Moments {
    double mean = 0.0, variance = 0.0;
};
/// Of the pixels that lie so many from the border.
Moments moments(const FluidImages& images, FieldId field, int border) {
    Moments m;
    double count = 0.0, square = 0.0;
    for (int y = border; y < images.height() - border; ++y)
        for (int x = border; x < images.width() - border; ++x) {
            const double z = double{images.at(field, x, y)} + 2.0;
            m.mean += z;
            square += z * z;
            count += 1.0;
        }
    m.mean /= count;
    m.variance = square / count - m.mean * m.mean;
    m.mean -= 2.0;
    return m;
}

} // namespace

TEST_CASE("fluid oracles: NDC depth of a plane is affine, so a symmetric filter of NDC depth returns it") {
    for (const bool is_ndc : {true, false}) {
        fluid::Settings s = blank(800, 1);
        s.camera.fov_y = 60.0F;
        s.switches.filter = fluid::Filter::gaussian;
        s.switches.filter_constants = fluid::FilterConstants::published;
        s.switches.depth_value = is_ndc ? fluid::DepthValue::ndc : fluid::DepthValue::view;
        // A row of a square image.
        FluidImages images(s);
        const auto plane = [](int x) { return -2.0 / (1.0 - 0.5 * slope(x, 800)); };
        images.fill(depth, [&](int x, int) { return is_ndc ? ndc_of(plane(x)) : plane(x); });
        images.run({"depth_filter_pass"});
        const double stored = double{images.at(smooth_depth, 500, 0)}, z = is_ndc ? z_of_ndc(stored) : stored;
        CHECK(fmt::format("{:.5f}", plane(500)) == "-2.15640");
        CHECK(std::abs(z - (is_ndc ? -2.156403116 : -2.156457785)) < (is_ndc ? 3e-5 : 3e-6));
    }
}

TEST_CASE("fluid oracles: a plane that faces the camera is kept by every filter in every kind of depth") {
    for (const FilterCase& one : filters)
        for (const auto value : {fluid::DepthValue::ndc, fluid::DepthValue::window, fluid::DepthValue::view}) {
            fluid::Settings s = with(blank(16, 12), one);
            s.switches.depth_value = value;
            FluidImages images(s);
            const double ndc = ndc_of(-2.0);
            const double stored = value == fluid::DepthValue::view  ? -2.0
                                  : value == fluid::DepthValue::ndc ? ndc
                                                                    : 0.5 * ndc + 0.5;
            images.fill(depth, [&](int, int) { return stored; });
            images.run({"depth_filter_pass"});
            INFO(one.name << ", depth value " << static_cast<int>(value));
            double worst = 0.0;
            for (int y = 0; y < images.height(); ++y)
                for (int x = 0; x < images.width(); ++x)
                    worst = std::max(worst, std::abs(double{images.at(smooth_depth, x, y)} / stored - 1.0));
            CHECK(worst < 1e-6);
        }
}

TEST_CASE("fluid oracles: at a step of a metre the metric bilateral keeps both sides, narrow range the far one") {
    for (const FilterCase& one : {filters[4], filters[5], filters[6]}) {
        fluid::Settings s = with(blank(60, 12), one);
        s.radius = 0.009375F;
        FluidImages images(s);
        images.fill(depth, [](int x, int) { return x < 30 ? -2.0 : -3.0; });
        images.run({"depth_filter_pass"});
        INFO(one.name);
        for (int x = 0; x < 60; ++x) {
            const float z = images.at(smooth_depth, x, 6);
            constexpr float rounding = 4e-6F; // of the sums
            if (x >= 30)
                CHECK(std::abs(z + 3.0F) < rounding);
            else if (one.filter == fluid::Filter::bilateral)
                CHECK(std::abs(z + 2.0F) < rounding);
            else
                CHECK((z < -2.0F + rounding && z > -2.0F - s.radius));
        }
        if (one.filter == fluid::Filter::narrow_range)
            CHECK(images.at(smooth_depth, 29, 6) < -2.0F);
    }
}

TEST_CASE("fluid oracles: of noise around a constant the variance falls and the mean stays") {
    for (const FilterCase& one : filters) {
        FluidImages images(with(blank(48, 40), one));
        images.fill(depth, noise);
        images.run({"depth_filter_pass"});
        const Moments before = moments(images, depth, 12), after = moments(images, smooth_depth, 12);
        INFO(fmt::format("{}: {:.3g} to {:.3g}", one.name, before.variance, after.variance));
        const bool is_flow = one.filter == fluid::Filter::curvature_flow;
        CHECK(after.variance < (is_flow ? 0.999 : 0.9) * before.variance);
        CHECK(std::abs(after.mean - before.mean) < 0.1 * std::sqrt(before.variance));
    }
}

TEST_CASE("fluid oracles: filters over a square commute with mirroring, and those of radius 0 copy") {
    for (const FilterCase& one : {filters[1], filters[5]}) {
        FluidImages images(with(blank(32, 24), one)), mirrored(with(blank(32, 24), one));
        images.fill(depth, noise);
        mirrored.fill(depth, [](int x, int y) { return noise(31 - x, 23 - y); });
        images.run({"depth_filter_pass"});
        mirrored.run({"depth_filter_pass"});
        double worst = 0.0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x)
                worst = std::max(worst, std::abs(double{images.at(smooth_depth, x, y)} -
                                                 double{mirrored.at(smooth_depth, 31 - x, 23 - y)}));
        CHECK(worst < 5e-6); // the order of the sum is the mirrored one
    }
    for (const FilterCase& one : filters) {
        if (one.filter != fluid::Filter::gaussian && one.filter != fluid::Filter::bilateral)
            continue;
        fluid::Settings s = with(blank(16, 12), one);
        s.filter_radius = 0;
        FluidImages images(s);
        images.fill(depth, noise);
        images.run({"depth_filter_pass"});
        for (int i = 0; i < 12; ++i)
            CHECK(images.at(smooth_depth, i, i) == images.at(depth, i, i));
    }
}

TEST_CASE("fluid oracles: the depth image is the least depth over all particles, at every pixel") {
    fluid::Settings s = heap(5);
    s.switches.scene_depth = fluid::SceneDepth::ignore;
    for (const auto shape : {fluid::Sphere::flat, fluid::Sphere::ray}) {
        s.switches.sphere = shape;
        FluidImages images(s);
        images.run({"sphere_depth_pass"});
        const fluid::Host& host = images.host();
        const glm::dmat4 view(host.view()), p(host.projection());
        const double r = double{s.radius}, k = static_cast<double>(s.height) * p[1][1];
        std::size_t wrong = 0, seen = 0, at_rims = 0;
        for (int y = 0; y < s.height; ++y)
            for (int x = 0; x < s.width; ++x) {
                const double sx = (2.0 * x + 1.0 - s.width) / s.width / p[0][0],
                             sy = (2.0 * y + 1.0 - s.height) / s.height / p[1][1];
                double nearest = -HUGE_VAL;
                bool rim = false;
                for (const glm::vec3& particle : s.particles) {
                    const glm::dvec3 c(view * glm::dvec4(glm::dvec3(particle), 1.0));
                    if (!std::isfinite(c.x + c.y + c.z))
                        continue;
                    double inside = 0.0, z = 0.0;
                    if (shape == fluid::Sphere::ray) {
                        if (!(-c.z > r + double{s.camera.near_plane}))
                            continue;
                        const glm::dvec3 d(sx, sy, -1.0);
                        const double dd = glm::dot(d, d), middle = glm::dot(d, c) / dd;
                        const glm::dvec3 l = c - middle * d;
                        inside = 1.0 - glm::dot(l, l) / (r * r);
                        z = -(middle - r * std::sqrt(std::max(inside, 0.0) / dd));
                    } else {
                        if (!(-c.z > double{s.camera.near_plane}))
                            continue;
                        const double half = 0.5 * k * r / -c.z;
                        const double nx = (x + 0.5 - (c.x * p[0][0] / -c.z + 1.0) * 0.5 * s.width) / half,
                                     ny = (y + 0.5 - (c.y * p[1][1] / -c.z + 1.0) * 0.5 * s.height) / half;
                        inside = 1.0 - nx * nx - ny * ny;
                        z = c.z + r * std::sqrt(std::max(inside, 0.0));
                    }
                    rim = rim || std::abs(inside) < 1e-4;
                    if (inside >= 0.0 && z < 0.0)
                        nearest = std::max(nearest, z);
                }
                const double is = double{images.at(depth, x, y)};
                seen += is != 0.0 ? 1 : 0;
                at_rims += rim ? 1 : 0;
                const bool agrees = is == 0.0 ? nearest == -HUGE_VAL : std::abs(is - nearest) < 2e-5;
                wrong += !rim && !agrees ? 1 : 0;
            }
        CHECK(wrong == 0);
        CHECK(seen > 100);
        CHECK(at_rims < 20);
    }
}

TEST_CASE("fluid oracles: no order of the particles changes a bit but of the thickness") {
    for (const auto value : {fluid::DepthValue::ndc, fluid::DepthValue::window, fluid::DepthValue::view}) {
        fluid::Settings s = heap(8);
        s.switches.depth_value = value;
        s.switches.thickness_sum = fluid::ThicknessSum::blend_exact;
        fluid::Settings turned = s;
        std::reverse(turned.particles.begin(), turned.particles.end());
        FluidImages one(s), other(turned);
        one.run();
        other.run();
        std::size_t differing = 0;
        for (const FieldId field :
             {depth, smooth_depth, fluid::field::normal, fluid::field::thickness, fluid::field::lit})
            for (int y = 0; y < s.height; ++y)
                for (int x = 0; x < s.width; ++x)
                    differing += one.word(field, x, y) != other.word(field, x, y) ? 1 : 0;
        CHECK(differing == 0);
    }
}

TEST_CASE("fluid oracles: normals of a sphere met by rays point away from its centre") {
    fluid::Settings s = sphere(0.5F, 256, {0.2F, 0.1F, -2.0F});
    s.switches.sphere = fluid::Sphere::ray;
    s.switches.filter = fluid::Filter::off;
    FluidImages images(s);
    images.run({"sphere_depth_pass", "normal_pass"});
    double worst = 1.0, sum = 0.0;
    int count = 0;
    for (int y = 2; y < 254; ++y)
        for (int x = 2; x < 254; ++x) {
            const double z = double{images.at(depth, x, y)};
            const glm::dvec3 e(-z * slope(x, 256), -z * slope(y, 256), z);
            const glm::dvec3 right = (e - glm::dvec3(0.2, 0.1, -2.0)) / 0.5;
            if (z == 0.0 || glm::dot(right, -glm::normalize(e)) < 0.3)
                continue;
            const double cosine = glm::dot(right, glm::dvec3(images.vector(fluid::field::normal, x, y)));
            worst = std::min(worst, cosine);
            sum += cosine;
            ++count;
        }
    CHECK(count > 5000);
    CHECK(sum / count > 0.999);
    CHECK(worst > 0.98);
}

TEST_CASE("fluid oracles: thickness adds up to the volume of the spheres") {
    const fluid::Settings s = sphere(0.05F, 200);
    FluidImages images(s);
    images.run({"scene_pass_depth", "thickness_pass"});
    const double pixel = 2.0 * 2.0 * fov_tangent / 200.0, right = 4.0 / 3.0 * std::numbers::pi * 1.25e-4;
    double volume = 0.0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
            volume += double{images.at(fluid::field::thickness, x, y)} * pixel * pixel;
    INFO(fmt::format("{:.4g} of {:.4g}", volume, right));
    CHECK(fmt::format("{:.4g}", right) == "0.0005236");
    CHECK(std::abs(volume / right - 1.0) < 0.01);
    fluid::Settings many = s;
    many.particles = std::vector<glm::vec3>(7, s.particles[0]);
    FluidImages seven(many);
    seven.run({"scene_pass_depth", "thickness_pass"});
    for (int x = 90; x < 110; ++x)
        CHECK(double{seven.at(fluid::field::thickness, x, 100)} ==
              Approx(7.0 * double{images.at(fluid::field::thickness, x, 100)}));
}

TEST_CASE("fluid oracles: by curvature flow a bump towards the camera sinks, and a plane never moves") {
    fluid::Settings s = blank(800, 800);
    s.switches.filter = fluid::Filter::curvature_flow;
    s.radius = 0.01F;
    FluidImages images(s);
    const auto bump = [](int x, int y) {
        const double dx = x - 400, dy = y - 400;
        return -2.0 + 0.01 * std::exp(-(dx * dx + dy * dy) / (2.0 * 25.0));
    };
    images.fill(depth, bump);
    images.fill(smooth_depth, bump);
    CHECK(fmt::format("{:.6f}", double{images.at(depth, 400, 400)}) == "-1.990000");
    // What is farther from the bump than steps are many does not reach it.
    const auto passes = images.passes("depth_filter_pass");
    REQUIRE(passes.size() == 60);
    constexpr int around = 64;
    SystemState before = fluid::start(s), after = before;
    std::vector<double> peaks;
    for (int y = 0; y < 800; ++y)
        for (int x = 0; x < 800; ++x) {
            before.set(depth, images.item(x, y), static_cast<float>(bump(x, y)));
            before.set(smooth_depth, images.item(x, y), static_cast<float>(bump(x, y)));
        }
    after.take(fluid::smooth_depth_image, before);
    for (std::size_t k = 0; k < passes.size(); ++k) {
        for (int y = 400 - around; y <= 400 + around; ++y)
            passes[k]->run({before.view(), 0}, named_profile("strict"), images.item(400 - around, y),
                           images.item(400 + around + 1, y), after[fluid::smooth_depth_image]);
        before.swap(fluid::smooth_depth_image, after);
        if ((k + 1) % 20 == 0)
            peaks.push_back(double{before.view().real(smooth_depth, images.item(400, 400))});
    }
    CHECK(fmt::format("{:.5f} {:.5f} {:.5f}", peaks[0], peaks[1], peaks[2]) == "-1.99119 -1.99211 -1.99287");
    CHECK(std::abs(peaks[0] + 1.991188) < 2e-6);
    CHECK(std::abs(peaks[1] + 1.992113) < 2e-6);
    CHECK(std::abs(peaks[2] + 1.992867) < 2e-6);
}

TEST_CASE("fluid oracles: Fresnel's term is R0 at 0 degrees and 1 at 90, monotone, and clear fluid shows the scene") {
    FluidImages images(blank(8, 8));
    images.set(fluid::field::thickness, 0, 0, 0.0F);
    Reading r(Portable{});
    const SystemView view = images.view();
    const fluid::Shading<Reading> shading{r, images.host(), view};
    const auto fresnel = [&](float cosine) { return static_cast<float>(shading.fresnel(Real(cosine))); };
    CHECK(fresnel(1.0F) == images.host().settings().shading.fresnel_r0);
    CHECK(fresnel(0.0F) == 1.0F);
    float before = 1.0F;
    for (int i = 0; i <= 100; ++i) {
        const float share = fresnel(static_cast<float>(i) / 100.0F);
        CHECK((share >= 0.0F && share <= before));
        before = share;
    }
    const auto through = shading.transmission(0, {Real(0.275F), Real(0.75F), Real(0.85F)});
    CHECK(static_cast<float>(through.x) == 1.0F);
    CHECK(static_cast<float>(through.y) == 1.0F);
    CHECK(static_cast<float>(through.z) == 1.0F);
}

} // namespace lockstep::test::oracles_test
