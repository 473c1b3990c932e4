#include <functional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>

#include "tests/lights/lights_run.hpp"
#include "tests/text_mutants.hpp"

namespace lockstep::test::mutants_test {

namespace lights = lockstep::lights;

namespace {

/// A room with a light on a voxel's point, whose range ends at other points, and one beside a wall.
lights::Settings mutants_room() {
    lights::Settings s = room(10);
    s.width = 40;
    s.height = 28;
    s.lights.push_back({.position = {0.5F, 2.5F, 0.5F}, .range = 2.0F, .colour = {0.5F, 0.25F, 0.75F}});
    s.lights.push_back({.position = {-7.9F, 3.0F, 2.0F},
                        .range = 3.0F,
                        .direction = {-1.0F, 0.0F, 0.0F},
                        .speed = 40.0F,
                        .colour = {1.0F, 0.5F, 0.25F}});
    s.lights.push_back({.position = {7.8F, 4.0F, -3.0F},
                        .range = 3.0F,
                        .direction = {1.0F, 0.0F, 0.0F},
                        .speed = 40.0F,
                        .colour = {0.5F, 0.75F, 0.25F}});
    s.switches.outside = lights::Outside::black;
    return s;
}

/// In which the change has something to do.
lights::Settings settings_of(const std::string& run) {
    lights::Settings s = mutants_room();
    if (run == "fixed64" || run == "fixed32") {
        s.switches.accumulate = run == "fixed64" ? lights::Accumulate::fixed64 : lights::Accumulate::fixed32;
    } else if (run == "nearest") {
        s.switches.interpolation = lights::Interpolation::nearest;
    } else if (run == "racing") {
        s.switches.accumulate = lights::Accumulate::racing;
    } else if (run == "cubic") {
        s.switches.interpolation = lights::Interpolation::tricubic;
        s.switches.supersample = lights::Supersample::one;
        s.ambient = glm::vec3(0.0F);
    } else if (run == "floor beyond the grid") {
        add_surface(s, plane_surface(24.0, 24.0), {0.0, 1.25, 0.0}, {128, 128, 128});
    } else if (run == "from below") {
        s.camera.eye = {2.0F, -4.0F, 12.0F};
    } else if (run == "bright background") {
        s.background = {0.25F, 0.5F, 0.125F};
    } else if (run == "linear8") {
        s.switches.encoding = lights::Encoding::linear8;
    } else if (run == "blend") {
        s.switches.accumulate = lights::Accumulate::blend;
    } else if (run == "forward") {
        s.switches.pipeline = lights::Pipeline::forward;
    } else if (run == "directionality") {
        s.switches.shading = lights::Shading::directionality;
    } else if (run == "light over the floor") {
        s.lights.push_back({.position = {1.0F, 0.125F, 1.0F},
                            .range = 2.0F,
                            .direction = {0.0F, -1.0F, 0.0F},
                            .speed = 40.0F,
                            .colour = {0.5F, 0.5F, 0.25F}});
    } else if (run == "voxels of half a metre") {
        s.grid = {.size = {32, 16, 32}, .voxel = 0.5F, .origin = {-8.0F, 0.0F, -8.0F}};
    }
    return s;
}

constexpr int frames = 2;

Outcome run_of(const std::string& shaders, const std::string& run) {
    return outcome_of([&] { return run_lights(settings_of(run), frames, CheckMode::resync, shaders); });
}

} // namespace

TEST_CASE("lights mutants: each text stands in the shipped shader as often as the catalogue says") {
    check_texts("lights");
}

TEST_CASE("lights mutants: some of each pass are found and named, and the shipped shaders are not") {
    if (!gl())
        return skip(gl().missing());
    CHECK(run_of("shaders/lights", "plain").verdict == "AGREE");
    check_mutants("lights",
                  {"direction_to_voxel", "carry_lost", "fraction_not_reduced", "lambert_not_clamped", "glow_not_fading",
                   "encoded_turned"},
                  run_of);
}

/// All of them, as a table: lockstep_tests_lights "[mutants]"
TEST_CASE("lights mutants: the whole catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    check_catalogue("lights", run_of);
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
    const auto zeros = [](const Uniforms&) { return glm::vec3(0.0F); };
    const auto transposed = [](const Uniforms& all) {
        return glm::transpose(std::get<glm::mat4>(all.at("u_ProjView")));
    };
    const auto without_view = [](const Uniforms&) { return host_of(mutants_room())->projection(); };
    const auto without_projection = [](const Uniforms&) { return view_matrix(mutants_room().camera); };
    const auto swapped = [](const Uniforms&) {
        return view_matrix(mutants_room().camera) * host_of(mutants_room())->projection();
    };
    const auto blended = [](GlDraw::Blend how) {
        return [how](GlPass& pass) {
            if (pass.name == "glow_pass" && pass.draw)
                pass.draw->blend = how;
        };
    };
    const auto without_depth_test = [](GlPass& pass) {
        if (pass.name == "gbuffer_pass" && pass.draw)
            pass.draw->has_depth = false;
    };
    const auto by_size = [](const Uniforms& all) {
        return std::get<glm::vec3>(all.at("u_GridEnd")) - std::get<glm::vec3>(all.at("u_GridOrigin"));
    };
    const auto fewer = [](const Uniforms& all) { return std::get<unsigned>(all.at("u_LightCount")) - 1; };
    return {
        {"buffers_not_swapped", "plain", "step_left_out", left_out("light_step_pass")},
        {"clear_left_out", "fixed64", "clear_left_out", left_out("light_volume_clear")},
        {"time_does_not_pass", "plain", "u_Tick: zero", uniform("light_step_pass", "u_Tick", zero)},
        {"walls_not_set", "plain", "u_GridEnd: zero", uniform("light_step_pass", "u_GridEnd", zeros)},
        {"offset_not_set", "plain", "corner_for_centre", uniform("light_volume_gather", "u_VoxelOffset", zero)},
        {"origin_not_set", "fixed64", "origin_ignored", uniform("light_volume_scatter", "u_GridOrigin", zeros)},
        {"last_light_left_out", "fixed64", "last_light_left_out",
         uniform("light_volume_scatter", "u_LightCount", fewer)},
        {"a_bit_too_many", "fixed32", "scale_doubled",
         uniform("light_volume_scatter", "u_FixedScale",
                 [](const Uniforms& all) { return 2.0F * std::get<float>(all.at("u_FixedScale")); })},
        {"ambient_not_set", "plain", "ambient_missing", uniform("deferred_light_pass", "u_Ambient", zeros)},
        {"sampling_without_origin", "plain", "grid_at_world_origin",
         uniform("deferred_light_pass", "u_GridOrigin", zeros)},
        {"sampling_in_metres", "voxels of half a metre", "place_in_metres",
         uniform("deferred_light_pass", "u_InvVoxelSize", [](const Uniforms&) { return 1.0F; })},
        {"eye_not_set", "plain", "u_Eye: zero", uniform("gbuffer_pass", "u_Eye", zeros)},
        {"gain_not_set", "plain", "glow_without_gain",
         uniform("glow_pass", "u_GlowGain", [](const Uniforms&) { return 1.0F; })},
        {"walls_by_size", "plain", "walls_by_size", uniform("light_step_pass", "u_GridEnd", by_size)},
        {"without_view", "plain", "view_missing", uniform("gbuffer_pass", "u_ProjView", without_view)},
        {"without_projection", "plain", "nothing_drawn", uniform("gbuffer_pass", "u_ProjView", without_projection)},
        {"matrices_swapped", "plain", "nothing_drawn", uniform("gbuffer_pass", "u_ProjView", swapped)},
        {"glow_matrices_swapped", "plain", "glow_missing", uniform("glow_pass", "u_ProjView", swapped)},
        {"matrix_transposed", "plain", "projection_transposed", uniform("gbuffer_pass", "u_ProjView", transposed)},
        {"glow_matrix_transposed", "plain", "projection_transposed", uniform("glow_pass", "u_ProjView", transposed)},
        {"without_depth_test", "plain", "last_triangle_stays", without_depth_test},
        {"glow_not_blended", "plain", "glow_not_blended", blended(GlDraw::Blend::none)},
        {"glow_blended_by_alpha", "plain", "glow_missing", blended(GlDraw::Blend::by_alpha)},
        {"disc_of_twice_the_size", "plain", "discs_twice_as_large",
         uniform("glow_pass", "u_DiscScale",
                 [](const Uniforms& all) { return 2.0F * std::get<float>(all.at("u_DiscScale")); })},
        {"disc_of_half_size", "plain", "discs_half_as_large",
         uniform("glow_pass", "u_DiscScale",
                 [](const Uniforms& all) { return 0.5F * std::get<float>(all.at("u_DiscScale")); })},
    };
}

} // namespace

TEST_CASE("lights mutants: what the host hands over wrongly is found, and most have their cause") {
    if (!gl())
        return skip(gl().missing());
    std::size_t with_cause = 0;
    const std::vector<HostMutant> all = host_catalogue();
    for (const HostMutant& mutant : all) {
        const lights::HostPtr host = host_of(settings_of(mutant.run));
        std::vector<GlPass> passes = lights::passes(host);
        for (GlPass& pass : passes)
            mutant.pass(pass);
        const System system = lights::system(host);
        GlSystemSide side(gl(), system, std::move(passes), "shaders/lights");
        CheckOptions options;
        options.frames = frames;
        const Outcome outcome = outcome_of([&] { return check(system, side, options); });
        with_cause += mutant.cause.empty() ? 0 : 1;
        INFO(mutant.name << ": " << outcome.verdict << ", " << fmt::format("{}", fmt::join(outcome.causes, " | ")));
        CHECK(outcome.found());
        CHECK((mutant.cause.empty() || outcome.names(mutant.cause)));
    }
    CHECK(10 * with_cause >= 7 * all.size());
}

} // namespace lockstep::test::mutants_test
