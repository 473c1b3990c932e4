#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/fluid/scene.hpp"
#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/shading.hpp"
#include "tests/fluid/fluid_images.hpp"

namespace lockstep::test::failures_test {

/// The ways in which the published technique goes wrong, each with what is measured of it.
namespace fluid = lockstep::fluid;

namespace {

using Reading = FluidImages::Reading;
using Real = Reading::Real;
using fluid::field::depth;
using fluid::field::lit;
using fluid::field::normal;
using fluid::field::smooth_depth;
using fluid::field::thickness;

float real_of(const Real& x) { return static_cast<float>(x); }

fluid::Settings scene(const std::string& name, const std::string& preset = "corrected",
                      const std::vector<std::string>& set = {}) {
    return fluid::load_scene("data/scenes/fluid/" + name + ".json", {.preset = preset, .set = set});
}

fluid::Settings sized(fluid::Settings s, int width, int height) {
    s.width = width;
    s.height = height;
    return s;
}

/// A row of pixels, -2 m before 32 and -3 m from there on, after one pass along it; back in metres.
double beside_step(fluid::Filter filter, fluid::FilterConstants constants, fluid::DepthValue value, int x) {
    fluid::Settings s = blank(64, 1);
    s.radius = 0.009375F;
    s.switches.filter = filter;
    s.switches.filter_constants = constants;
    s.switches.depth_value = value;
    FluidImages images(s);
    Reading r(Portable{});
    const fluid::DepthCode<Reading> code(r, images.host());
    images.fill(depth, [&](int at, int) { return double{real_of(code.stored(Real(at < 32 ? -2.0F : -3.0F)))}; });
    const SystemView view = images.view();
    const fluid::DepthFilterTwin twin{host_of(s), {fluid::FilterStep::Shape::along, {1, 0}, true}};
    double z = 0.0;
    twin(r, {view, 0}, images.item(x, 0)).for_each([&](const auto& word) {
        if constexpr (std::is_same_v<std::decay_t<decltype(word)>, Real>)
            z = double{real_of(code.decoded(word))};
    });
    return z;
}

double range_weight(const fluid::Host& host, double behind) {
    const auto ndc = [&](double z) {
        return (double{host.depth_coefficients().x} * z + double{host.depth_coefficients().y}) / -z;
    };
    const double step = (ndc(-2.0 - behind) - ndc(-2.0)) * double{host.range_scale()};
    return std::exp(-step * step);
}

/// The depths of a row of an image, filtered.
FluidImages filtered(fluid::Settings s, const std::function<double(int x, int y)>& z) {
    FluidImages images(std::move(s));
    images.fill(depth, z).run({"depth_filter_pass"});
    return images;
}

fluid::Settings narrow(int width, int height, fluid::NarrowCleanup cleanup) {
    fluid::Settings s = blank(width, height);
    s.switches.filter = fluid::Filter::narrow_range;
    s.switches.narrow_cleanup = cleanup;
    return s;
}

/// Mean squared difference of neighbours' normals, where both are fluid.
double bumpiness(const FluidImages& images) {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < images.height(); ++y)
        for (int x = 1; x < images.width(); ++x) {
            if (images.at(normal, x, y, 3) == 0.0F || images.at(normal, x - 1, y, 3) == 0.0F)
                continue;
            const glm::vec3 step = images.vector(normal, x, y) - images.vector(normal, x - 1, y);
            sum += double{glm::dot(step, step)};
            count += 1.0;
        }
    return sum / count;
}

std::size_t fluid_pixels(const FluidImages& images, float empty = 0.0F) {
    std::size_t count = 0;
    for (int y = 0; y < images.height(); ++y)
        for (int x = 0; x < images.width(); ++x)
            count += images.at(depth, x, y) != empty ? 1 : 0;
    return count;
}

} // namespace

TEST_CASE("fluid failures, edge_smear: the gaussian and the published bilateral draw a step of a metre apart") {
    using F = fluid::Filter;
    using C = fluid::FilterConstants;
    using D = fluid::DepthValue;
    const auto told = [](double z) { return fmt::format("{:.4f}", z); };
    CHECK(told(beside_step(F::gaussian, C::published, D::ndc, 31)) == "-2.3725");
    CHECK(told(beside_step(F::bilateral, C::published, D::ndc, 31)) == "-2.3660");
    CHECK(std::abs(beside_step(F::bilateral, C::metric, D::view, 31) + 2.0) < 1e-6);
    CHECK(std::abs(beside_step(F::bilateral, C::metric, D::view, 32) + 3.0) < 1e-6);
    CHECK(std::abs(beside_step(F::narrow_range, C::metric, D::view, 32) + 3.0) < 1e-6);
    CHECK(std::abs(beside_step(F::narrow_range, C::metric, D::view, 31) + 2.0) < 0.009375);
    CHECK(beside_step(F::curvature_flow, C::metric, D::view, 31) == -2.0);
}

TEST_CASE("fluid failures, bilateral_is_gaussian: the published range weight protects no edge") {
    fluid::Settings s = blank(8, 8);
    s.switches.filter_constants = fluid::FilterConstants::published;
    const fluid::Host host(s);
    CHECK(fmt::format("{:.4f} {:.3f} {:.3f}", range_weight(host, 0.1), range_weight(host, 0.5),
                      range_weight(host, 2.0)) == "0.9994 0.990 0.939");
}

TEST_CASE("fluid failures, narrow_range_gap: the gaussian distorts both sides of a gap, narrow range keeps the far") {
    const auto worst = [](const std::vector<std::string>& set) {
        fluid::Settings s = scene("two_layers", "corrected", set);
        s = sized(s, 160, 160);
        s.radius = 0.05F;
        s.filter_radius = 8;
        FluidImages images(s);
        images.run({"scene_pass_depth", "sphere_depth_pass", "depth_filter_pass"});
        double moved = 0.0;
        for (int x = 0; x < 160; ++x) {
            const double before = double{images.at(depth, x, 80)}, after = double{images.at(smooth_depth, x, 80)};
            if (before < -2.8 && before != 0.0)
                moved = std::max(moved, after - before);
        }
        return moved;
    };
    const double gaussian = worst({"filter=gaussian"}), bilateral = worst({"filter=bilateral"}),
                 range = worst({"filter=narrow_range"});
    INFO(fmt::format("gaussian {:.3f} bilateral {:.3f} narrow range {:.3f} m", gaussian, bilateral, range));
    CHECK(gaussian > 0.3);
    CHECK(bilateral < 0.06);
    CHECK(range < 0.06);
}

TEST_CASE("fluid failures, box_not_gaussian: weights of texture coordinates are one") {
    const auto weight = [](fluid::NarrowWeights how) {
        fluid::Settings s = blank(800, 800);
        s.switches.narrow_weights = how;
        const FluidImages images(s);
        Reading r(Portable{});
        const SystemView view = images.view();
        const fluid::DepthMap<Reading> map(r, images.host(), view, depth);
        return real_of(fluid::NarrowRange<Reading>(r, images.host(), map).weight(7, 0, 7));
    };
    CHECK(fmt::format("{:.6f}", weight(fluid::NarrowWeights::texcoord)) == "0.999993");
    CHECK(fmt::format("{:.4f}", weight(fluid::NarrowWeights::pixels)) == "0.0111");
}

TEST_CASE("fluid failures, cleanup_cross: the clean-up by quadrants never samples straight above or beside a pixel") {
    // Only the clean-up sees a pixel that both passes before it left: a dent beside the pixel.
    const auto moved = [](fluid::NarrowCleanup how, int dx, int dy) {
        const fluid::Settings s = narrow(33, 400, how);
        FluidImages images(s);
        images.fill(smooth_depth, [&](int x, int y) { return x == 16 + dx && y == 200 + dy ? -2.02 : -2.0; });
        const ItemPass* const cleanup = images.passes("depth_filter_pass").back();
        images.run_at(*cleanup, 16, 200);
        return images.at(smooth_depth, 16, 200) != -2.0F;
    };
    using Cleanup = fluid::NarrowCleanup;
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{-2, 0}, std::pair{0, -2}}) {
        CHECK_FALSE(moved(Cleanup::quadrants, dx, dy));
        CHECK(moved(Cleanup::full, dx, dy));
    }
    CHECK(moved(Cleanup::quadrants, 1, 1));
    CHECK(moved(Cleanup::full, 1, 1));
}

TEST_CASE("fluid failures, depth_convention: window depth that is read as NDC depth") {
    fluid::Settings s = blank(8, 8);
    s.switches.depth_value = fluid::DepthValue::window;
    for (const auto& [unproject, right] :
         {std::pair{fluid::Unproject::stored, "-1.96"}, std::pair{fluid::Unproject::as_ndc, "-3.84"}}) {
        s.switches.unproject = unproject;
        const fluid::Host host(s);
        Reading r(Portable{});
        const fluid::DepthCode<Reading> code(r, host);
        CHECK(fmt::format("{:.2f}", real_of(code.unprojected(code.stored(Real(-1.96F))))) == right);
    }
}

TEST_CASE("fluid failures, near_black: as NDC depth what is nearer than 0.2 m is black") {
    const auto black = [](const std::string& value) {
        FluidImages images(sized(scene("near_camera", "corrected", {"depth_value=" + value, "filter=off"}), 60, 60));
        images.run({"scene_pass", "scene_pass_depth", "sphere_depth_pass", "normal_pass", "thickness_pass",
                    "fluid_shade_pass"});
        int count = 0;
        for (int y = 0; y < images.height(); ++y)
            for (int x = 0; x < images.width(); ++x)
                count += images.vector(lit, x, y) == glm::vec3(0.0F) ? 1 : 0;
        return count;
    };
    CHECK(black("ndc") > 20);
    CHECK(black("window") == 0);
    CHECK(black("view") == 0);
}

TEST_CASE("fluid failures, pull_away, border: narrow range draws silhouettes back, and repeats the image's edge") {
    const auto strip =
        filtered(narrow(64, 400, fluid::NarrowCleanup::off), [](int x, int) { return x >= 20 && x < 44 ? -2.0 : 0.0; });
    const float edge = strip.at(smooth_depth, 20, 200);
    CHECK(edge < -2.0F);
    CHECK(edge > -2.0F - strip.host().narrow_mu());
    CHECK(strip.at(smooth_depth, 32, 200) == -2.0F);
    CHECK(strip.at(smooth_depth, 19, 200) == 0.0F);
    const auto tilted =
        filtered(narrow(64, 400, fluid::NarrowCleanup::off), [](int x, int) { return -2.0 + 0.001 * x; });
    CHECK(double{tilted.at(smooth_depth, 32, 200)} == Approx(-1.968).margin(1e-6));
    CHECK(double{tilted.at(smooth_depth, 0, 200)} - -2.0 > 2e-4);
}

TEST_CASE("fluid failures, grazing_alias: of a surface seen edge-on narrow range refuses every pair") {
    const auto z = [](int x, int y) { return -8.0 + 0.12 * x + 0.002 * ((x * 7 + y * 3) % 5); };
    const auto steep = filtered(narrow(32, 1600, fluid::NarrowCleanup::off), z);
    for (int x = 8; x < 24; ++x)
        CHECK(steep.at(smooth_depth, x, 800) ==
              Approx(static_cast<float>(z(x, 800))).margin(0.012)); // along y alone it is filtered
    FluidImages across(narrow(32, 1600, fluid::NarrowCleanup::off));
    across.fill(depth, z).run_one(*across.passes("depth_filter_pass")[0]);
    for (int x = 8; x < 24; ++x)
        CHECK(across.at(smooth_depth, x, 800) == across.at(depth, x, 800));
}

TEST_CASE("fluid failures, bumpy: unfiltered every particle is a ball") {
    const auto of = [](const std::string& filter) {
        fluid::Settings s = sized(scene("tilted_sheet", "corrected", {"filter=" + filter}), 100, 100);
        s.filter_radius = 6;
        FluidImages images(s);
        images.run({"scene_pass_depth", "sphere_depth_pass", "depth_filter_pass", "normal_pass"});
        return bumpiness(images);
    };
    const double off = of("off"), gaussian = of("gaussian"), bilateral = of("bilateral"), range = of("narrow_range");
    INFO(fmt::format("off {:.4f}, gaussian {:.5f}, bilateral {:.5f}, narrow range {:.5f}", off, gaussian, bilateral,
                     range));
    CHECK(off > 0.02);
    CHECK(gaussian < 0.1 * off);
    CHECK(bilateral < 0.2 * off);
    CHECK(range < 0.3 * off);
}

TEST_CASE("fluid failures, flicker: unfiltered a pixel's normal leaps from frame to frame") {
    const auto of = [](const std::string& filter) {
        fluid::Settings s = sized(scene("wave", "corrected", {"filter=" + filter}), 60, 60);
        s.filter_radius = 6;
        s.tick = 0.01F;
        FluidImages images(s), next(s);
        for (const auto& [one, frame] : {std::pair{&images, 0}, std::pair{&next, 1}})
            one->run({"motion_pass", "scene_pass_depth", "sphere_depth_pass", "depth_filter_pass", "normal_pass"},
                     frame);
        double sum = 0.0, count = 0.0;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x) {
                if (images.at(normal, x, y, 3) == 0.0F || next.at(normal, x, y, 3) == 0.0F)
                    continue;
                const glm::vec3 step = images.vector(normal, x, y) - next.vector(normal, x, y);
                sum += double{glm::dot(step, step)};
                count += 1.0;
            }
        return sum / count;
    };
    const double off = of("off"), bilateral = of("bilateral");
    INFO(fmt::format("off {:.4f}, bilateral {:.4f}", off, bilateral));
    CHECK(bilateral < 0.5 * off);
}

TEST_CASE("fluid failures, half_pixel_normal: at a sphere's middle the smaller step is always the flat side") {
    fluid::Settings s = sphere(0.5F, 800);
    s.switches.sphere = fluid::Sphere::ray;
    s.switches.filter = fluid::Filter::off;
    FluidImages images(s);
    for (int y = 398; y <= 401; ++y)
        for (int x = 499; x <= 501; ++x)
            images.run_at(*images.passes("sphere_depth_pass")[0], x, y);
    for (const int y : {399, 400})
        images.run_at(*images.passes("normal_pass")[0], 500, y);
    CHECK(images.vector(normal, 500, 400).y == 0.0F);
    CHECK(images.vector(normal, 500, 399).y == 0.0F);
}

TEST_CASE("fluid failures, sky_below: the direction to the eye mirrored, sky and ground change places") {
    const auto sky = [](fluid::Mirror how) {
        fluid::Settings s = blank(8, 8);
        s.switches.mirror = how;
        const FluidImages images(s);
        Reading r(Portable{});
        const SystemView view = images.view();
        const fluid::Shading<Reading> shading{r, images.host(), view};
        // A level surface seen from above.
        const auto v = shading.sky({Real(0.0F), Real(0.6F), Real(0.8F)}, {Real(0.0F), Real(1.0F), Real(0.0F)});
        return fmt::format("{:.2f} {:.2f} {:.2f}", real_of(v.x), real_of(v.y), real_of(v.z));
    };
    CHECK(sky(fluid::Mirror::incident) == "0.12 0.24 0.96");
    CHECK(sky(fluid::Mirror::as_published) == "0.10 0.10 0.20");
}

TEST_CASE("fluid failures, fresnel_late: with a power of 50 water mirrors nothing but at its rim") {
    const auto fresnel = [](int power) {
        fluid::Settings s = blank(8, 8);
        s.shading.fresnel_r0 = 0.05F;
        s.shading.fresnel_power = power;
        const FluidImages images(s);
        Reading r(Portable{});
        const SystemView view = images.view();
        return real_of(fluid::Shading<Reading>{r, images.host(), view}.fresnel(Real(0.2F)));
    };
    CHECK(fmt::format("{:.5f}", fresnel(50)) == "0.05001");
    CHECK(fmt::format("{:.3f}", fresnel(5)) == "0.361");
}

TEST_CASE("fluid failures, thickness_floor: a single drop is as dark as twelve behind one another") {
    const auto dark = [](const std::string& floor, int particle) {
        fluid::Settings s =
            scene("row_of_drops", "corrected", {"thickness_kind=published", "thickness_floor=" + floor});
        FluidImages images(s);
        images.run({"scene_pass_depth", "thickness_pass"});
        const fluid::Host& host = images.host();
        const glm::vec4 clip =
            host.view_projection() * glm::vec4(s.particles[static_cast<std::size_t>(particle)], 1.0F);
        const int x = static_cast<int>((clip.x / clip.w + 1.0F) * 100.0F),
                  y = static_cast<int>((clip.y / clip.w + 1.0F) * 100.0F);
        Reading r(Portable{});
        const SystemView view = images.view();
        const fluid::Shading<Reading> shading{r, host, view};
        return real_of(shading.transmission(images.item(x, y), {Real(0.275F), Real(0.75F), Real(0.85F)}).x);
    };
    CHECK(dark("0.3", 0) == dark("0.3", 12));
    CHECK(dark("0", 0) > 0.95F);
    CHECK(dark("0", 12) < 0.9F);
}

TEST_CASE("fluid failures, thick_twice: thickness is the sum of the spheres, not of what they fill") {
    fluid::Settings s = sphere(0.05F, 64);
    FluidImages one(s);
    s.particles.push_back(s.particles[0]);
    FluidImages two(s);
    one.run({"scene_pass_depth", "thickness_pass"});
    two.run({"scene_pass_depth", "thickness_pass"});
    CHECK(one.at(thickness, 32, 32) > 0.08F);
    CHECK(two.at(thickness, 32, 32) == 2.0F * one.at(thickness, 32, 32));
    CHECK(two.at(depth, 32, 32) == one.at(depth, 32, 32));
}

TEST_CASE("fluid failures, seen_through: with scene_depth ignore fluid is drawn through a wall") {
    const auto behind = [](const std::string& how) {
        FluidImages images(sized(scene("behind_wall", "corrected", {"scene_depth=" + how}), 80, 80));
        images.run({"scene_pass", "scene_pass_depth", "sphere_depth_pass"});
        int count = 0;
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 80; ++x) {
                Reading r(Portable{});
                const fluid::DepthCode<Reading> code(r, images.host());
                const float z = images.at(depth, x, y);
                count +=
                    z != 0.0F && real_of(code.window(Real(z))) >= images.at(fluid::field::scene_depth, x, y) ? 1 : 0;
            }
        return count;
    };
    CHECK(behind("test") == 0);
    CHECK(behind("ignore") > 250);
}

TEST_CASE("fluid failures, flat_sphere: off the axis a flat sprite is narrower than the sphere") {
    const auto covered = [](fluid::Sphere shape) {
        fluid::Settings s = sphere(0.05F, 200, {0.8F, 0.0F, -2.0F});
        s.switches.sphere = shape;
        FluidImages images(s);
        images.run({"sphere_depth_pass"});
        return fluid_pixels(images);
    };
    CHECK(covered(fluid::Sphere::flat) == 58);
    CHECK(covered(fluid::Sphere::ray) == 60);
}

} // namespace lockstep::test::failures_test
