#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/collision/judge/step_cause.hpp"
#include "crosscheck/judge/compare.hpp"
#include "reference/collision/deviating_obstacles.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/camera.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/collision/deviating_step.hpp"

namespace lockstep::test::cause_test {

namespace {

constexpr int width = 48;
constexpr int height = 36;

/// A few frames of a scene where every step matters: a moving camera, hits, particles at the border, an obstacle.
class Run {
  public:
    Run(const std::string& preset_name, RasterPosition raster_position, const std::string& profile_name)
        : profile_(named_profile(profile_name)) {
        RandomScene random = random_scene(17, 300, width, height);
        scene_.start = random.particles;
        scene_.width = width;
        scene_.height = height;
        scene_.cdt_box = {glm::vec3(-2.0F), glm::vec3(2.0F)};
        scene_.constants = random.params.constants;
        scene_.constants.collision_range = range;
        scene_.constants.gravity = {0.1F, -0.9F, 0.2F};
        scene_.camera = {.eye = {0.1F, -0.2F, 3.0F}, .fov_y = 40.0F};
        scene_.camera_path = {{0, {0.1F, -0.2F, 3.0F}, {0.0F, 0.0F, 0.0F}},
                              {8, {0.6F, 0.1F, 3.2F}, {0.0F, 0.0F, 0.0F}}};
        scene_.switches = preset(preset_name);
        scene_.switches.raster_position = raster_position;
        scene_.obstacles.positions = {{-0.8F, -0.9F, 0.02F}, {0.7F, -0.8F, 0.01F}, {0.1F, 0.5F, -0.03F}};
        scene_.obstacles.indices = {0, 1, 2};
        // Pairs of particles at the same place, for equal depths and distances; some still count at 0.
        for (std::size_t i = 0; i + 1 < scene_.start.size(); i += 10)
            scene_.start.position[i + 1] = scene_.start.position[i];
        for (std::size_t i = 0; i < scene_.start.size(); i += 7)
            scene_.start.collide_time[i] = 0.0F;
        for (std::size_t i = 0; i < scene_.start.size(); i += 11)
            scene_.start.speed[i] = 3e-39F;
        ReferenceSimulation simulation(scene_, profile_);
        states_.push_back({scene_.start, random.cdt});
        for (int frame = 0; frame < frames; ++frame) {
            simulation.step_from(states_.back().particles, states_.back().cdt, frame_params(scene_, frame));
            states_.push_back({simulation.particles(), simulation.cdt()});
            // A little of everything again, so that no frame runs out of it.
            State& state = states_.back();
            for (std::size_t i = 0; i < state.particles.size(); i += 3) {
                state.particles.collide_time[i] = scene_.start.collide_time[i];
                state.particles.speed[i] = scene_.start.speed[i];
            }
            plant(state, frame + 1, 0, {0.25F, -0.125F, 0.0F}, {{-0.5F, 0.0F}, {0.0F, 0.5F}});
            plant(state, frame + 1, 1, {-0.25F, 0.25F, 0.0F}, {{1.0F, 0.0F}, {1.0F, 0.0F}});
            plant(state, frame + 1, 2, {range / 4.0F, range / 8.0F, 0.0F}, {});
            plant(state, frame + 1, 3, {0.5F, 0.25F, 0.0F}, {{0.5F, 0.0F}, {0.0F, 0.25F}, {-0.75F, 0.0F}});
            plant_at_border(state, frame + 1, 6, -0.3F, true);
            plant_at_border(state, frame + 1, 7, 0.3F, false);
            // Behind one another, at the same depth.
            state.particles.position[5] = state.particles.position[4] = {-0.5F, 0.5F, 0.0F};
        }
    }

    struct State {
        Particles particles;
        CollisionImage cdt;
    };
    struct Result {
        CauseFindings particles, texels;
        [[nodiscard]] const CauseFindings& found() const { return particles.divergent > 0 ? particles : texels; }
    };

    /// The reference with `deviations` plays the GPU, in frames 2 and 3.
    [[nodiscard]] Result with(
        const Deviations& deviations, const std::function<void(Particles&)>& spoil = [](Particles&) {}) const {
        const std::vector<NamedMistake> named = named_mistakes(scene_, profile_);
        ItemCauseFinder of_step(named, step_name(scene_.switches));
        TexelCauses of_texels;
        Result result;
        for (int frame = 2; frame < frames; ++frame) {
            const auto t = static_cast<std::size_t>(frame);
            const State& before = states_[t];
            const State& earlier = states_[t - 1];
            const FrameParams params = frame_params(scene_, frame);
            const FrameParams earlier_params = frame_params(scene_, frame - 1);
            ReferenceSimulation reference(scene_, profile_);
            reference.step_from(before.particles, before.cdt, params);
            const CollisionImage drawn = reference.cdt();
            FrameInputs inputs{.before = &before.particles,
                               .cdt = &before.cdt,
                               .params = &params,
                               .earlier = &earlier.particles,
                               .earlier_cdt = &earlier.cdt,
                               .earlier_params = &earlier_params,
                               .drawn_cdt = &drawn};
            State gpu = before;
            for (std::size_t i = 0; i < gpu.particles.size(); ++i)
                gpu.particles.set(i, deviating_step(inputs, i, profile_, deviations));
            spoil(gpu.particles);
            CollisionImage no_obstacles(width, height);
            DepthImage depth(width, height, 1.0F);
            obstacle_pass(scene_.obstacles, params, profile_, no_obstacles, depth);
            deviating_obstacles(scene_.obstacles, params, profile_, drawn_wrong(deviations), no_obstacles, depth);
            deviating_draw(inputs, gpu.particles, profile_, drawn_wrong(deviations), no_obstacles, depth, gpu.cdt);
            const KnownOperations known = measured_operations(profile_);
            const JudgedFrame judged{
                scene_.obstacles,      params,          profile_,      known,  before.particles, before.cdt,
                reference.particles(), reference.cdt(), gpu.particles, gpu.cdt};
            const FrameVerdicts verdicts = judge(judged);
            if (!deviations.has(Deviation::current_frame_cdt))
                inputs.drawn_cdt = &gpu.cdt;
            add_causes(judged, verdicts, inputs, of_step, of_texels);
        }
        result.particles = of_step.findings();
        result.texels = of_texels.findings();
        return result;
    }

  private:
    [[nodiscard]] Deviations drawn_wrong(const Deviations& deviations) const {
        Deviations drawn;
        for (const DeviationInfo& info : deviation_table())
            if (deviations.has(info.deviation) &&
                changes_drawing(info.deviation, scene_.switches.arithmetic == ArithmeticSwitch::exact))
                drawn.add(info.deviation);
        return drawn;
    }

    /// Particle i at a place with nothing round it but neighbours at these offsets, in ranges.
    void plant(State& state, int frame, std::size_t i, glm::vec3 place, const std::vector<glm::vec2>& neighbours) {
        state.particles.set(i, {place, {0.0F, 1.0F, 0.0F}, 0.5F, -0.5F});
        const FrameParams params = frame_params(scene_, frame);
        const BaseTexelIndex base = base_texel(place, params, profile_);
        int x = base.x - 1;
        for (int ty = -1; ty <= 1; ++ty)
            for (int tx = -1; tx <= 1; ++tx)
                state.cdt.at(base.x + tx, base.y + ty) = glm::vec4(0.0F);
        state.cdt.at(base.x, base.y) = glm::vec4(place, 1.0F);
        for (const glm::vec2 off : neighbours)
            state.cdt.at(x++, base.y - 1) = glm::vec4(place + glm::vec3(off * range, 0.0F), 1.0F);
    }

    /// Particle i on the left column: the texels round it hold what is far, its own one is empty unless `stored`, and
    /// those on the other side of the image hold what is near.
    void plant_at_border(State& state, int frame, std::size_t i, float y, bool stored) {
        const FrameParams params = frame_params(scene_, frame);
        glm::vec3 place(-2.0F, y, 0.0F);
        while (base_texel(place, params, profile_).x < 0)
            place.x += 0x1p-8F;
        state.particles.set(i, {place, {0.0F, 1.0F, 0.0F}, 0.5F, -0.5F});
        const BaseTexelIndex base = base_texel(place, params, profile_);
        for (int ty = -1; ty <= 1; ++ty) {
            state.cdt.at(0, base.y + ty) = state.cdt.at(1, base.y + ty) = glm::vec4(9.0F, 9.0F, 9.0F, 1.0F);
            state.cdt.at(width - 1, base.y + ty) = glm::vec4(place + glm::vec3(0.5F * range, 0.0F, 0.0F), 1.0F);
        }
        state.cdt.at(base.x, base.y) = stored ? glm::vec4(place, 1.0F) : glm::vec4(0.0F);
    }

    static constexpr float range = 0x1p-5F;
    static constexpr int frames = 4;
    Scene scene_;
    Profile profile_;
    std::vector<State> states_;
};

bool names(const CauseFindings& found, Deviation deviation) {
    for (const Cause& cause : found.best)
        if (cause.mistakes == std::vector{std::string(deviation_name(deviation))})
            return true;
    return false;
}

} // namespace

TEST_CASE("cause: every deviation that shows is found by its name, alone or beside its equals") {
    const Run runs[] = {{"corrected", RasterPosition::updated, "llvmpipe"},
                        {"paper", RasterPosition::before_step, "llvmpipe"},
                        {"exact", RasterPosition::updated, "strict"},
                        {"corrected", RasterPosition::before_step, "strict"}};
    std::map<Deviation, bool> shown, first;
    for (const Run& run : runs) {
        for (const DeviationInfo& info : deviation_table()) {
            if (first[info.deviation])
                continue;
            const Run::Result result = run.with(info.deviation);
            const CauseFindings& found = result.found();
            if (found.divergent == 0)
                continue;
            INFO(info.name << ": " << (found.best.empty() ? "nothing" : found.best.front().name()));
            shown[info.deviation] = true;
            CHECK(found.explains_all());
            CHECK(names(found, info.deviation));
            first[info.deviation] = !found.best.empty() && found.best.front().mistakes.front() == info.name;
        }
    }
    std::string hidden, second;
    for (const DeviationInfo& info : deviation_table()) {
        if (!shown[info.deviation])
            hidden.append(info.name).append(" ");
        else if (!first[info.deviation])
            second.append(info.name).append(" ");
    }
    // Who does not search moves in all of them (twin/not_searching_twin_test.cpp); nobody is beyond the near or the far
    // plane, nor in the near half, and no triangle is clockwise.
    CHECK(hidden == "moves_without_search point_depth_clamped near_half_discarded obstacle_counterclockwise_alone ");
    // What another mistake may do just as well: searching in the wrong place, say.
    CHECK(second == "radius_one_less outside_fetched_as_origin point_without_divide fragment_depth_reversed point_flat "
                    "point_depth_doubled fragment_depth_zero obstacle_depth_not_halved obstacle_depth_zero "
                    "obstacle_depth_reversed obstacle_clockwise_alone ");
}

TEST_CASE("cause: two deviations at once are found as a pair") {
    using enum Deviation;
    const Run run("corrected", RasterPosition::updated, "llvmpipe");
    const std::pair<Deviation, Deviation> pairs[] = {{last_column_skipped, gravity_doubled},
                                                     {last_found_instead_of_nearest, speed_kept_at_hit},
                                                     {collide_time_not_tested, collide_time_counted_up},
                                                     {y_flipped, tick_missing_in_move}};
    for (const auto& [a, b] : pairs) {
        const CauseFindings found = run.with(Deviations(a).add(b)).particles;
        INFO(deviation_name(a) << " + " << deviation_name(b));
        REQUIRE(found.explains_all());
        CHECK(found.best.front().mistakes.size() == 2);
        CHECK(std::any_of(found.best.begin(), found.best.end(), [&](const Cause& cause) {
            return cause.mistakes == std::vector{std::string(deviation_name(std::min(a, b))),
                                                 std::string(deviation_name(std::max(a, b)))};
        }));
    }
    const CauseFindings drawn = run.with(Deviations(point_half_pixel_up).add(depth_not_tested)).texels;
    REQUIRE(drawn.explains_all());
    CHECK(drawn.best.front().name() == "point_half_pixel_up + depth_not_tested");
}

TEST_CASE("cause: a driver that rounds otherwise does not hide the name") {
    using enum Deviation;
    const Run run("corrected", RasterPosition::updated, "nvidia");
    for (const Deviation deviation : {last_found_instead_of_nearest, gravity_doubled, y_flipped}) {
        const CauseFindings found = run.with(Deviations(deviation).add(sums_left_to_right)).particles;
        INFO(deviation_name(deviation));
        REQUIRE(found.explains_all());
        CHECK(found.best.front().name() == deviation_name(deviation));
    }
    CHECK(run.with(sums_left_to_right).particles.best.empty());
}

TEST_CASE("cause: what is no named deviation is never said to be one") {
    const Run run("corrected", RasterPosition::updated, "llvmpipe");
    const auto spoil = [](Particles& p, const auto& change) {
        for (std::size_t i = 0; i < p.size(); ++i)
            change(p, i);
    };
    const auto unit_up = [](float& x) { x = std::nextafter(x, 1e9F); };
    const CauseFindings biased =
        run.with({}, [&](Particles& gpu) { spoil(gpu, [&](Particles& p, std::size_t i) { unit_up(p.speed[i]); }); })
            .particles;
    CHECK(biased.divergent > 0);
    CHECK_FALSE(biased.explains_all());
    const CauseFindings mixed = run.with({},
                                         [&](Particles& gpu) {
                                             spoil(gpu, [&](Particles& p, std::size_t i) {
                                                 if (i % 2 == 0)
                                                     p.collide_time[i] *= 1.5F;
                                                 else
                                                     p.position[i].y *= 1.01F;
                                             });
                                         })
                                    .particles;
    CHECK(mixed.divergent > 0);
    CHECK_FALSE(mixed.explains_all());
}

} // namespace lockstep::test::cause_test
