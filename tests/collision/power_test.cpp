#include <catch2/catch.hpp>

#include <atomic>
#include <map>
#include <string>
#include <utility>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/judge/collision_power.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/profile.hpp"
#include "tests/collision/deviating_step.hpp"

namespace lockstep::test::power_test {

using test::deviating_step;

namespace {

/// An engine that computes what the reference computes, with a mistake made. Needs no GL.
class MistakenEngine : public GpuSide {
  public:
    MistakenEngine(const Scene& scene, const Profile& profile, Deviation deviation)
        : scene_(scene), profile_(profile), deviation_(deviation), right_(scene, profile) {}

    void upload(const Particles& particles, const CollisionImage& cdt) override { now_ = {particles, cdt}; }
    void step(const FrameParams& params) override {
        right_.step_from(now_.particles, now_.cdt, params);
        FrameInputs inputs{.before = &now_.particles, .cdt = &now_.cdt, .params = &params, .drawn_cdt = &right_.cdt()};
        const FrameParams earlier_params = frame_params(scene_, std::max(frame_ - 1, 0));
        if (frame_++ > 0) {
            inputs.earlier = &earlier_.particles;
            inputs.earlier_cdt = &earlier_.cdt;
            inputs.earlier_params = &earlier_params;
        }
        Both next{now_.particles, CollisionImage(params.width, params.height)};
        for (std::size_t i = 0; i < next.particles.size(); ++i)
            next.particles.set(i, deviating_step(inputs, i, profile_, deviation_));
        CollisionImage obstacles(params.width, params.height);
        DepthImage depth(params.width, params.height, 1.0F);
        obstacle_pass(scene_.obstacles, params, profile_, obstacles, depth);
        deviating_draw(inputs, next.particles, profile_, deviation_, obstacles, depth, next.cdt);
        earlier_ = std::exchange(now_, std::move(next));
    }
    void read(Particles& particles) const override { particles = now_.particles; }
    void read(CollisionImage& cdt) const override { cdt = now_.cdt; }

  private:
    struct Both {
        Particles particles;
        CollisionImage cdt;
    };
    const Scene& scene_;
    const Profile& profile_;
    Deviation deviation_;
    ReferenceSimulation right_;
    Both now_, earlier_;
    int frame_ = 0;
};

} // namespace

TEST_CASE("power: what a run says would have shown is found by its frame, and nearly nothing else") {
    const auto [name, preset] = GENERATE(std::pair<std::string, std::string>{"crowd", "corrected"},
                                         std::pair<std::string, std::string>{"borders", "paper"},
                                         std::pair<std::string, std::string>{"near_ties", "corrected"},
                                         std::pair<std::string, std::string>{"behind_camera", "paper"});
    const Scene scene = load_scene("data/scenes/stress/" + name + ".json", {.preset = preset});
    const Profile profile = named_profile("llvmpipe");
    std::size_t shown = 0, missed = 0;
    for (const DeviationInfo& info : deviation_table()) {
        if (!counts_in_power(info.deviation))
            continue;
        if (is_no_mistake(info.deviation, scene.switches, profile))
            continue;
        MistakenEngine engine(scene, profile, info.deviation);
        CheckOptions options;
        options.frames = 4;
        options.causes = false;
        const CheckReport report = check(scene, profile, engine, options);
        const auto mistake = std::find_if(report.power.mistakes.begin(), report.power.mistakes.end(),
                                          [&](const PowerSummary::Mistake& m) { return m.name == info.name; });
        REQUIRE(mistake != report.power.mistakes.end());
        INFO(name << ", " << preset << ", " << info.name << ": " << mistake->why_not);
        const bool found = report.verdict == Verdict::divergent;
        if (mistake->first_frame) {
            REQUIRE(found);
            CHECK(*report.first_frame <= *mistake->first_frame);
        }
        if (found && !mistake->first_frame) { // it showed in a few items, none of which was tried
            CHECK(report.verdicts->total(DifferenceClass::divergent) <= 32);
            ++missed;
        }
        shown += mistake->first_frame ? 1 : 0;
    }
    CHECK(shown > 80);
    CHECK(missed <= 2);
}

TEST_CASE("power: a run in which nothing collides shows no mistake of the search, and says why") {
    Scene scene = load_scene("data/scenes/stress/crowd.json", {});
    scene.constants.collision_range = 1e-6F;
    const Profile profile = named_profile("llvmpipe");
    MistakenEngine engine(scene, profile, Deviation::last_found_instead_of_nearest);
    CheckOptions options;
    options.frames = 6;
    const CheckReport report = check(scene, profile, engine, options);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried == std::vector<std::string>{"nothing collided"});
    for (const PowerSummary::Mistake& mistake : report.power.mistakes)
        if (mistake.name == "last_found_instead_of_nearest")
            CHECK(mistake.why_not == "nothing collided");
}

} // namespace lockstep::test::power_test
