#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/shading.hpp"
#include "reference/fluid/sprite.hpp"
#include "tests/fluid/fluid_images.hpp"

namespace lockstep::test::worked_numbers_test {

/// Numbers that were worked out beforehand, by another program: nine digits are the float.
namespace fluid = lockstep::fluid;

namespace {

using Reading = FluidImages::Reading;
using Real = Reading::Real;

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
float real_of(const Real& x) { return static_cast<float>(x); }

fluid::Settings in_value(fluid::Settings s, fluid::DepthValue value) {
    s.switches.depth_value = value;
    return s;
}

/// A camera whose P11 is that of the published code, 1.792591.
fluid::Settings published_camera() {
    fluid::Settings s = blank(800, 800);
    s.camera.fov_y = 58.3101F;
    s.radius = 0.009375F;
    return s;
}

/// A column of pixels with depths from the middle on to both sides, of a height that makes n = 4 at z = -2.
FluidImages narrow_row() {
    fluid::Settings s = blank(9, 500);
    s.switches.filter = fluid::Filter::narrow_range;
    s.switches.narrow_cleanup = fluid::NarrowCleanup::off;
    FluidImages images(s);
    constexpr std::array<float, 9> z{-2.05F, -2.03F, -2.02F, -2.00F, -2.0F, -2.01F, -1.99F, -2.30F, -1.50F};
    images.fill(fluid::field::depth, [&](int x, int) { return double{z[static_cast<std::size_t>(x)]}; });
    return images;
}

} // namespace

TEST_CASE("fluid worked numbers, F1: a point of a sphere in each kind of depth") {
    fluid::Settings s = sphere(0.05F, 200);
    for (const auto& [value, stored] :
         {std::pair{fluid::DepthValue::ndc, 0x3f665d29U}, std::pair{fluid::DepthValue::window, bits(0.949929476F)},
          std::pair{fluid::DepthValue::view, bits(-1.96000004F)}}) {
        const fluid::Host host(in_value(s, value));
        CHECK(host.depth_coefficients().x == -1.002002F);
        CHECK(fmt::format("{:.7f}", host.depth_coefficients().y) == "-0.2002002");
        Reading r(Portable{});
        const SystemState state = fluid::start(host.settings());
        const SystemView view = state.view();
        const fluid::SpriteTwin<Reading> sprite(r, host, view, {fluid::Sphere::flat, 0.05F});
        const Real nz = sprite.height(Real(0.6F) * Real(0.6F));
        CHECK(real_of(nz) == 0.800000012F);
        const Real z = Real(-2.0F) + Real(0.05F) * nz;
        CHECK(real_of(z) == -1.96000004F);
        const fluid::DepthCode<Reading> code(r, host);
        CHECK(bits(real_of(code.stored(z))) == stored);
        CHECK(std::abs(real_of(code.decoded(code.stored(z))) + 1.96F) < 2e-6F);
        CHECK(real_of(code.ndc(z)) == 0.899859011F);
        CHECK(real_of(code.window(z)) == 0.949929476F);
    }
}

TEST_CASE("fluid worked numbers, F2: sprites and kernels") {
    fluid::Settings s = published_camera();
    s.switches.filter_constants = fluid::FilterConstants::published;
    s.switches.point_scale = fluid::PointScale::width_60;
    const fluid::Host published(s);
    const double r = double{s.radius};
    CHECK(fmt::format("{:.4f}", double{published.point_scale()} * r / 2.0) == "6.4952");
    s.switches.point_scale = fluid::PointScale::projection;
    s.switches.filter_constants = fluid::FilterConstants::metric;
    const fluid::Host metric(s);
    CHECK(fmt::format("{:.3f}", double{metric.point_scale()} * r / 2.0) == "6.722");
    CHECK(fmt::format("{:.6f}", published.weights()[15]) == "0.105399");
    double sum = -1.0;
    for (std::size_t j = 0; j <= 15; ++j)
        sum += 2.0 * double{published.weights()[j]};
    CHECK(fmt::format("{:.4f}", sum) == "17.2239");
    const auto range = [&](double step) { return std::exp(-std::pow(step * double{metric.range_scale()}, 2.0)); };
    CHECK(fmt::format("{:.3f} {:.5f}", range(0.01), range(0.1)) == "0.950 0.00598");
}

TEST_CASE("fluid worked numbers, F3: four samples to each side of the narrow-range filter") {
    FluidImages images = narrow_row();
    Reading r(Portable{});
    const SystemView view = images.view();
    const fluid::DepthMap<Reading> map(r, images.host(), view, fluid::field::depth);
    const fluid::NarrowRange<Reading> filter(r, images.host(), map);
    const auto weight = [&](int j) { return fmt::format("{:.6f}", real_of(filter.weight(j, 0, 4))); };
    CHECK(weight(1) == "0.754840");
    CHECK(weight(2) == "0.324652");
    CHECK(weight(3) == "0.079560");
    CHECK(weight(4) == "0.011109");
    const float z = real_of(filter.at(4, 250, images.host().filter_steps()[0], Real(-2.0F)));
    CHECK(std::abs(double{z} + 2.00421262) < 1e-6);
    // Without its bias correction a refused sample's partner is kept.
    const std::array<Mistake, 1> kept{mistake_at(fluid::site::partner_weight, Change::never)};
    const auto words =
        images.passes("depth_filter_pass")[0]->mistaken({view, 0}, images.item(4, 250), named_profile("strict"), kept);
    CHECK(fmt::format("{:.6f}", std::bit_cast<float>(words[0])) == "-2.004365");
}

TEST_CASE("fluid worked numbers, F4: a point and the normal of a sphere met by a ray") {
    fluid::Settings s = sphere(0.5F, 800);
    s.switches.sphere = fluid::Sphere::ray;
    s.switches.filter = fluid::Filter::off;
    FluidImages images(s);
    for (const auto& [dx, dy] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
        images.run_at(*images.passes("sphere_depth_pass")[0], 500 + dx, 400 + dy);
    images.run_at(*images.passes("normal_pass")[0], 500, 400);
    Reading r(Portable{});
    const float z = images.at(fluid::field::depth, 500, 400);
    const auto e = fluid::point_at(r, images.host(), 500, 400, Real(z));
    CHECK(fmt::format("{:.6f} {:.6f} {:.6f}", real_of(e.x), real_of(e.y), real_of(e.z)) ==
          "0.225375 0.001121 -1.553676");
    const glm::vec3 n = images.vector(fluid::field::normal, 500, 400);
    CHECK(double{n.x} == Approx(0.448337).margin(1e-4));
    CHECK(n.y == 0.0F);
    CHECK(double{n.z} == Approx(0.893865).margin(1e-4));
    const glm::dvec3 right = (glm::dvec3(floats(e)) - glm::dvec3(0.0, 0.0, -2.0)) / 0.5;
    CHECK(fmt::format("{:.5f} {:.5f} {:.5f}", right.x, right.y, right.z) == "0.45075 0.00224 0.89265");
}

TEST_CASE("fluid worked numbers, F5: what three spheres let through") {
    fluid::Settings s = sphere(0.05F, 8);
    s.switches.thickness_sum = fluid::ThicknessSum::fixed;
    for (const bool has_floor : {false, true}) {
        s.shading.thickness_floor = has_floor ? 0.3F : 0.0F;
        s.switches.thickness_sum = fluid::ThicknessSum::blend;
        FluidImages images(s);
        images.set(fluid::field::thickness, 0, 0, 0.24F);
        Reading r(Portable{});
        const SystemView view = images.view();
        const fluid::Shading<Reading> shading{r, images.host(), view};
        const auto through = shading.transmission(0, {Real(0.275F), Real(0.75F), Real(0.85F)});
        CHECK(fmt::format("{:.6f} {:.6f} {:.6f}", real_of(through.x), real_of(through.y), real_of(through.z)) ==
              (has_floor ? "0.804528 0.927743 0.955997" : "0.840297 0.941765 0.964640"));
    }
    const auto units = [](float nz) { return static_cast<int>(std::floor(65536.0F * (0.1F * nz) + 0.5F)); };
    CHECK(units(1.0F) == 6554);
    CHECK(units(0.8F) == 5243);
    CHECK(units(0.6F) == 3932);
}

TEST_CASE("fluid worked numbers, F6: Fresnel's term and the highlight") {
    Reading r(Portable{});
    const auto fresnel = [&](float r0, float cosine, int power = 5) {
        fluid::Settings s = blank(8, 8);
        s.shading.fresnel_r0 = r0;
        s.shading.fresnel_power = power;
        const FluidImages images(s);
        const SystemView view = images.view();
        return double{real_of(fluid::Shading<Reading>{r, images.host(), view}.fresnel(Real(cosine)))};
    };
    const auto near = [](double right) { return Approx(right).margin(1.5e-6); };
    CHECK(fresnel(0.020373F, 1.0F) == near(0.020373));
    CHECK(fresnel(0.020373F, 0.8F) == near(0.020687));
    CHECK(fresnel(0.020373F, 0.5F) == near(0.050987));
    CHECK(fresnel(0.020373F, 0.2F) == near(0.341377));
    CHECK(fresnel(0.020373F, 0.0F) == near(1.000000));
    CHECK(fresnel(0.05F, 0.8F) == near(0.050304));
    CHECK(fresnel(0.05F, 0.5F) == near(0.079687));
    CHECK(fresnel(0.05F, 0.2F) == near(0.361296));
    CHECK(fresnel(0.05F, 0.2F, 50) == Approx(0.05001).margin(5e-6));
    const float shine = real_of(product_power(Real(0.999F), 500));
    CHECK(bits(shine) == 0x3f1b3c13U);
    CHECK(shine == 0.60638541F);
}

TEST_CASE("fluid worked numbers: the exponential is the float nearest to e^x, or one beside it") {
    Reading r(Portable{});
    std::uint32_t farthest = 0;
    for (int i = 0; i < 87000; ++i) {
        const float x = -static_cast<float>(i) / 1000.0F;
        const std::uint32_t is = bits(real_of(portable_exponential(r, fluid::site::in_exponent, Real(x)))),
                            right = bits(static_cast<float>(std::exp(double{x})));
        farthest = std::max(farthest, is > right ? is - right : right - is);
    }
    CHECK(farthest == 1);
    CHECK(real_of(portable_exponential(r, fluid::site::in_exponent, Real(0.0F))) == 1.0F);
    CHECK(real_of(portable_exponential(r, fluid::site::in_exponent, Real(-87.5F))) == 0.0F);
}

} // namespace lockstep::test::worked_numbers_test
