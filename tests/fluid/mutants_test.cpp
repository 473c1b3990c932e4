#include <cmath>
#include <functional>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "tests/fluid/fluid_run.hpp"
#include "tests/text_mutants.hpp"

namespace lockstep::test::mutants_test {

namespace fluid = lockstep::fluid;

namespace {

constexpr int frames = 1;

/// Each pixel its own sphere at its own depth: steps of every size beside each other, and here and there no neighbour.
fluid::Settings relief() {
    fluid::Settings s;
    s.width = 24;
    s.height = 20;
    s.camera = {.eye = {}, .target = {0.0F, 0.0F, -1.0F}, .fov_y = 60.0F, .near_plane = 0.125F, .far_plane = 40.0F};
    const double pixel = 2.0 * std::tan(glm::radians(30.0)) / s.height; // at 1 m
    s.radius = static_cast<float>(0.95 * pixel);
    Random random(5, 0);
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
            const double away = 1.0 + 15.0 * s.radius * random.unit();
            if (random.unit() < 0.75)
                s.particles.emplace_back(away * pixel * (x + 0.5 - 0.5 * s.width),
                                         away * pixel * (y + 0.5 - 0.5 * s.height), -away);
        }
    return s;
}

/// In which the change has something to do.
fluid::Settings settings_of(const std::string& run) {
    const bool is_relief = run.starts_with("relief") || run == "narrow" || run == "quadrants" || run == "paper";
    fluid::Settings s = is_relief ? relief() : heap(5);
    s.filter_radius = 3;
    s.flow_iterations = 2;
    fluid::Switches& on = s.switches;
    if (run == "ray") {
        on.sphere = fluid::Sphere::ray;
    } else if (run == "ndc" || run == "d24") {
        on.depth_value = fluid::DepthValue::ndc;
        // Behind the sphere that would hide the others; depths near 0 have codes that are more than rounding apart.
        s.camera.near_plane = run == "d24" ? 1.0F : 0.5F;
        on.depth_format = run == "d24" ? fluid::DepthFormat::d24 : fluid::DepthFormat::r32f;
        s.arithmetic = run == "d24" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain; // else codes are open
    } else if (run == "window") {
        on.depth_value = fluid::DepthValue::window;
        s.camera.near_plane = 0.5F;
    } else if (run == "builtin") {
        on.transcendentals = fluid::Transcendentals::builtin;
    } else if (run == "near_ndc") {
        on.depth_value = fluid::DepthValue::ndc;
        on.filter_constants = fluid::FilterConstants::published;
        s.camera.near_plane = 1.0F;
    } else if (run == "full2d") {
        on.filter_shape = fluid::FilterShape::full2d;
    } else if (run == "narrow" || run == "quadrants") {
        on.filter = fluid::Filter::narrow_range;
        on.narrow_cleanup = run == "narrow" ? fluid::NarrowCleanup::full : fluid::NarrowCleanup::quadrants;
    } else if (run == "paper") { // large enough for filters of many pixels
        s.width *= 3;
        s.height *= 3;
        return with(in_preset(s, "paper"), {"filter=narrow_range"});
    } else if (run == "flow" || run == "relief_flow") {
        on.filter = fluid::Filter::curvature_flow;
    } else if (run == "fixed") {
        on.thickness_sum = fluid::ThicknessSum::fixed;
    } else if (run == "mirror") {
        on.mirror = fluid::Mirror::as_published;
    } else if (run == "relief_edges") {
        on.edge_normal = fluid::EdgeNormal::published;
    } else if (run == "floor") {
        s.shading.thickness_floor = 0.3F;
    } else if (run == "near") {
        s.particles.emplace_back(0.5839F, 0.8624F, 1.9087F); // 0.1 m before the camera
    } else if (run == "behind") {
        place(sphere_surface(0.05, 2), {.position = {0.49, 0.77, 1.72}}, s.obstacles);
    } else if (run == "large") { // spheres that reach into each other and into the floor
        s.radius = 0.125F;
        s.camera.near_plane = 0.5F;
    } else if (run == "low") { // before a floor that reaches far
        s.camera.eye.y = 0.45F;
    } else if (run == "aside" || run == "beyond") { // of the spot of light; of the world's origin
        const glm::vec3 by = run == "aside" ? glm::vec3(200.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 0.0F, -4.0F);
        for (glm::vec3& particle : s.particles)
            particle += by;
        s.camera.eye += by;
        s.camera.target += by;
    } else if (run == "moves") {
        s.wave = fluid::Wave{.amplitude = 0.05F, .length = 0.5F, .period = 1.0F};
    }
    return s;
}

Outcome run_of(const std::string& shaders, const std::string& run) {
    return outcome_of([&] { return run_fluid(settings_of(run), frames, CheckMode::resync, shaders); });
}

} // namespace

TEST_CASE("fluid mutants: each text stands in the shipped shader as often as the catalogue says") {
    check_texts("fluid");
}

TEST_CASE("fluid mutants: some of each pass are found and named, and the shipped shaders are not") {
    if (!gl())
        return skip(gl().missing());
    CHECK(run_of("shaders/fluid", "plain").verdict == "AGREE");
    check_mutants("fluid",
                  {"back_of_sphere", "empty_not_skipped", "partner_kept", "cross_turned", "even_discs",
                   "refraction_left_out", "scene_depth_turned", "quadrants_rows_first", "narrow_empty_refused",
                   "narrow_millimetre_nearer", "disc_a_little_small", "thickness_left_out_here_and_there",
                   "mirror_from_eye", "edges_facing_where_published", "no_thickness_fixed"},
                  run_of);
}

/// All of them, as a table: lockstep_tests_fluid "[mutants]"
TEST_CASE("fluid mutants: the whole catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    check_catalogue("fluid", run_of);
}

/// No false alarm: lockstep_tests_fluid "[mutants]"
TEST_CASE("fluid mutants: the shipped shaders agree in every run of the catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string run :
         {"plain",     "ray",   "ndc",    "d24",         "window", "near_ndc", "builtin",     "full2d", "narrow",
          "quadrants", "flow",  "relief", "relief_flow", "near",   "behind",   "large",       "low",    "aside",
          "beyond",    "fixed", "floor",  "moves",       "paper",  "mirror",   "relief_edges"}) {
        INFO(run);
        const std::string verdict = run_of("shaders/fluid", run).verdict;
        const bool leaves_open = run == "builtin" || run == "paper"; // exp and pow
        CHECK((verdict == "AGREE" || (leaves_open && verdict == "LEGAL")));
    }
}

namespace {

/// A mistake of the host: what it hands the shaders is another thing than what the twins get.
struct HostMutant {
    std::string name, run, cause; ///< as a report names it
    std::function<void(GlPass&)> pass;
};

std::function<void(GlPass&)> uniform(const std::string& of, const std::string& name,
                                     const std::function<UniformValue(const Uniforms&)>& wrong) {
    return [=](GlPass& pass) {
        if (pass.name != of || pass.continues)
            return;
        pass.uniforms = [right = pass.uniforms, name, wrong](int frame) {
            Uniforms all = right(frame);
            all[name] = wrong(all);
            return all;
        };
    };
}

std::function<void(GlPass&)> left_out(const std::string& name) {
    return [=](GlPass& pass) {
        if (pass.name == name)
            pass.runs = [](int) { return false; };
    };
}

std::vector<HostMutant> host_catalogue() {
    const auto zero = [](const Uniforms&) { return 0.0F; };
    const auto transposed = [](const char* name) {
        return [name](const Uniforms& all) { return glm::transpose(std::get<glm::mat4>(all.at(name))); };
    };
    const auto scaled = [](const char* name, float by) {
        return [name, by](const Uniforms& all) { return by * std::get<float>(all.at(name)); };
    };
    const auto over_p11 = [](int power) {
        return [power](const Uniforms& all) {
            const float p11 = std::get<glm::mat4>(all.at("projection"))[1][1];
            return std::get<float>(all.at("pointScale")) / std::pow(p11, static_cast<float>(power));
        };
    };
    const auto negated = [](const Uniforms& all) { return -std::get<glm::vec2>(all.at("u_DepthCoefficients")); };
    const auto from_0 = [](const Uniforms& all) {
        const glm::mat4 p = std::get<glm::mat4>(all.at("projection"));
        return 0.5F * (glm::vec2(p[2][2], p[3][2]) + glm::vec2(-1.0F, 0.0F));
    };
    const auto of_pixels = [](const Uniforms& all) { return 2.0F / std::get<glm::vec2>(all.at("screenSize")); };
    const auto scales = [](const Uniforms& all) {
        const glm::mat4 p = std::get<glm::mat4>(all.at("projection"));
        return glm::vec2(p[0][0], p[1][1]);
    };
    return {
        {"motion_left_out", "moves", "motion_left_out", left_out("motion_pass")},
        {"thickness_not_cleared", "fixed", "clear_left_out", left_out("thickness_clear_pass")},
        {"thickness_without_blending", "plain", "not_blended",
         [](GlPass& pass) {
             if (pass.name == "thickness_pass" && pass.draw)
                 pass.draw->blend = GlDraw::Blend::none;
         }},
        {"thickness_with_depth_test", "plain", "first_sphere_alone",
         [](GlPass& pass) {
             if (pass.name == "thickness_pass" && pass.draw)
                 pass.draw->has_depth = true;
         }},
        {"spheres_without_depth_test", "plain", "last_sphere",
         [](GlPass& pass) {
             if (pass.name == "sphere_depth_pass" && pass.draw)
                 pass.draw->has_depth = false;
         }},
        {"vertical_pass_twice", "plain", "axes_swapped",
         uniform("depth_filter_pass", "blurDir", [](const Uniforms&) { return glm::ivec2(0, 1); })},
        {"radius_doubled", "plain", "pointRadius: doubled",
         uniform("sphere_depth_pass", "pointRadius", scaled("pointRadius", 2.0F))},
        {"scale_halved", "plain", "half_of_half", uniform("thickness_pass", "pointScale", scaled("pointScale", 0.5F))},
        {"scale_by_width", "plain", "scale_by_width",
         uniform("sphere_depth_pass", "pointScale", scaled("pointScale", 44.0F / 36.0F))},
        {"scale_without_angle", "plain", "scale_without_angle",
         uniform("sphere_depth_pass", "pointScale", over_p11(1))},
        {"scale_by_tangent", "plain", "scale_by_tangent", uniform("thickness_pass", "pointScale", over_p11(2))},
        {"near_and_far_swapped", "behind", "ndc_turned", uniform("sphere_depth_pass", "u_DepthCoefficients", negated)},
        {"depth_from_0", "ndc", "depth_from_0", uniform("sphere_depth_pass", "u_DepthCoefficients", from_0)},
        {"near_not_set", "ray", "near_plane_ignored", uniform("sphere_depth_pass", "u_Near", zero)},
        {"view_transposed", "beyond", "view_transposed", uniform("sphere_depth_pass", "mView", transposed("mView"))},
        {"range_scale_not_set", "plain", "range_weight_left_out", uniform("depth_filter_pass", "u_RangeScale", zero)},
        {"range_scale_of_the_image", "plain", "range_by_blur_scale",
         uniform("depth_filter_pass", "u_RangeScale",
                 [](const Uniforms& all) { return std::get<float>(all.at("blurScale")); })},
        {"range_sigma_3_times", "relief", "range_sigma",
         uniform("depth_filter_pass", "u_RangeScale", scaled("u_RangeScale", 1.0F / 3.0F))},
        {"radius_of_the_filter", "plain", "ends_left_out",
         uniform("depth_filter_pass", "filterRadius",
                 [](const Uniforms& all) { return std::get<int>(all.at("filterRadius")) - 1; })},
        {"mu_not_set", "narrow", "u_NarrowMu: zero", uniform("depth_filter_pass", "u_NarrowMu", zero)},
        {"flow_step_doubled", "flow", "flow_step_doubled",
         uniform("depth_filter_pass", "u_FlowStep", scaled("u_FlowStep", 2.0F))},
        {"flow_without_angle", "flow", "flow_without_angle", uniform("depth_filter_pass", "u_FlowScale", of_pixels)},
        {"gain_doubled", "plain", "thickness_doubled",
         uniform("thickness_pass", "u_ThicknessGain", scaled("u_ThicknessGain", 2.0F))},
        {"inverse_view_transposed", "plain", "u_InverseView: transposed",
         uniform("fluid_shade_pass", "u_InverseView", transposed("u_InverseView"))},
        {"r0_not_set", "plain", "fresnel_without_r0", uniform("fluid_shade_pass", "u_FresnelR0", zero)},
        {"fresnel_power_3", "plain", "fresnel_power",
         uniform("fluid_shade_pass", "u_FresnelPower", [](const Uniforms&) { return 3; })},
        {"slope_is_scale", "plain", "slope_turned", uniform("normal_pass", "u_Slope", scales)},
        {"slope_of_x", "plain", "u_Slope.y: instead u_Slope.x",
         uniform("normal_pass", "u_Slope",
                 [](const Uniforms& all) { return glm::vec2(std::get<glm::vec2>(all.at("u_Slope")).x); })},
    };
}

} // namespace

TEST_CASE("fluid mutants: what the host hands over wrongly is found, and most have their cause") {
    if (!gl())
        return skip(gl().missing());
    std::size_t with_cause = 0;
    const std::vector<HostMutant> all = host_catalogue();
    for (const HostMutant& mutant : all) {
        const fluid::HostPtr host = host_of(settings_of(mutant.run));
        std::vector<GlPass> passes = fluid::passes(host);
        for (GlPass& pass : passes)
            mutant.pass(pass);
        const System system = fluid::system(host);
        GlSystemSide side(gl(), system, std::move(passes), "shaders/fluid");
        CheckOptions options;
        options.frames = 2;
        const Outcome outcome = outcome_of([&] { return check(system, side, options); });
        with_cause += mutant.cause.empty() ? 0 : 1;
        INFO(mutant.name << ": " << outcome.verdict << ", " << fmt::format("{}", fmt::join(outcome.causes, " | ")));
        CHECK(outcome.found());
        CHECK((mutant.cause.empty() || outcome.names(mutant.cause)));
    }
    CHECK(10 * with_cause >= 6 * all.size());
}

} // namespace lockstep::test::mutants_test
