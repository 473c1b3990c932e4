#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::passes_test {

namespace fluid = lockstep::fluid;

namespace {

using Strings = std::vector<std::string>;

} // namespace

TEST_CASE("fluid passes: every pass of every preset agrees, or differs as GL allows") {
    if (!gl())
        return skip(gl().missing());
    const std::string preset = GENERATE("corrected", "exact", "paper");
    const CheckReport report = run_fluid(in_preset(heap(), preset), 2);
    CAPTURE(preset);
    INFO(report_text(report, {}));
    if (preset == "paper")
        CHECK(passes(report));
    else
        CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried.empty());
}

TEST_CASE("fluid passes: a run that draws no fluid says so") {
    if (!gl())
        return skip(gl().missing());
    fluid::Settings s = in_preset(heap(), "corrected");
    for (glm::vec3& particle : s.particles)
        particle = s.camera.eye + (s.camera.eye - s.camera.target) + 0.01F * particle; // behind the camera
    const CheckReport report = run_fluid(s, 2);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried == std::vector<std::string>{"4 of 8 passes changed nothing",
                                                     "all pixels are alike in the depth of the spheres, the filtered "
                                                     "depth, the normals and the thickness"});
    CHECK(report.without_effect ==
          std::vector<std::string>{"depth_filter_pass", "normal_pass", "sphere_depth_pass", "thickness_pass"});
}

TEST_CASE("fluid passes: a point whose middle lies beside the image is not drawn, a quad is") {
    if (!gl())
        return skip(gl().missing());
    const std::string sprite = GENERATE("sprite=points", "sprite=quad");
    fluid::Settings s = with(in_preset(heap(), "corrected"), {sprite, "filter=off"});
    s.camera.eye = {0.35F, 0.5F, 1.0F};
    const CheckReport report = run_fluid(s, 1);
    INFO(sprite << "\n" << report_text(report, {}));
    CHECK(passes(report));
}

TEST_CASE("fluid passes: every filter agrees in both arithmetics") {
    if (!gl())
        return skip(gl().missing());
    const std::string preset = GENERATE("corrected", "exact");
    const Strings values = GENERATE(
        Strings{"filter=off"}, Strings{"filter=gaussian"}, Strings{"filter=gaussian", "filter_shape=full2d"},
        Strings{"filter=bilateral", "filter_shape=full2d"}, Strings{"filter=bilateral", "filter_constants=published"},
        Strings{"filter=narrow_range"}, Strings{"filter=narrow_range", "narrow_cleanup=quadrants"},
        Strings{"filter=narrow_range", "narrow_cleanup=off", "narrow_weights=texcoord", "narrow_fov=fixed45"},
        Strings{"filter=curvature_flow"});
    const CheckReport report = run_fluid(with(in_preset(heap(), preset), values), 1);
    INFO(fmt::format("{} {}", preset, fmt::join(values, " ")) << "\n" << report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE("fluid passes: every value of every switch that promises bits agrees") {
    if (!gl())
        return skip(gl().missing());
    const Strings values =
        GENERATE(Strings{"depth_value=ndc", "difference_pick=nearer", "scene_depth=ignore"},
                 Strings{"depth_value=window", "filter=narrow_range", "edge_normal=published"},
                 Strings{"depth_value=window", "unproject=as_ndc", "mirror=as_published", "encoding=linear8"},
                 Strings{"depth_value=ndc", "depth_format=d24", "filter_constants=published"},
                 Strings{"sphere=ray", "thickness_kind=published", "thickness_sum=fixed", "scene_fetch=nearest"},
                 Strings{"point_size=distance", "point_scale=width_60", "thickness_sum=blend_exact"},
                 Strings{"sphere=ray", "depth_value=window", "filter=curvature_flow"});
    const std::string preset = GENERATE("corrected", "exact");
    const CheckReport report = run_fluid(with(in_preset(heap(), preset), values), 1);
    INFO(fmt::format("{} {}", preset, fmt::join(values, " ")) << "\n" << report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE("fluid passes: what GL leaves open is legal") {
    if (!gl())
        return skip(gl().missing());
    const Strings values = GENERATE(Strings{"sprite=points"}, Strings{"depth_fetch=linear"},
                                    Strings{"scene_fetch=linear"}, Strings{"transcendentals=builtin"},
                                    Strings{"encoding=srgb_hw"}, Strings{"filter=gaussian", "transcendentals=builtin"});
    const CheckReport report = run_fluid(with(heap(), values), 1);
    INFO(fmt::format("{}", fmt::join(values, " ")) << "\n" << report_text(report, {}));
    CHECK(passes(report));
}

TEST_CASE("fluid passes: the GPU's clock runs through every pass, also through those that dispatch") {
    if (!gl())
        return skip(gl().missing());
    fluid::Settings settings = with(heap(), {"filter=gaussian"});
    settings.width = settings.height = 400;
    settings.filter_radius = 15;
    const fluid::HostPtr host = host_of(settings);
    const System system = fluid::system(host);
    GlSystemSide side(gl(), system, fluid::passes(host), "shaders/fluid");
    std::vector<double> largest_share(system.passes.size());
    for (int repeat = 0; repeat < 5; ++repeat) { // a clock may be read late where others use the machine
        side.upload(system.start.view());
        side.time_steps(true);
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            side.step(p, 0);
            largest_share[p] = std::max(largest_share[p], side.seconds().timer / side.seconds().wall);
        }
        side.time_steps(false);
    }
    std::size_t filter_steps = 0;
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        if (system.passes[p]->name() != "depth_filter_pass")
            continue;
        CHECK(largest_share[p] > 0.5);
        ++filter_steps;
    }
    CHECK(filter_steps == 2);
}

} // namespace lockstep::test::passes_test
