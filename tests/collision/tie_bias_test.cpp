#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/collision/judge/diagnosis.hpp"
#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::tie_bias_test {

namespace {

constexpr int side = 500;
const std::vector<Extent> extents{{}, {side, side}};

/// The projection that puts everything so many 1/256 pixels further right and up.
glm::mat4 shifted(glm::mat4 m, glm::vec2 steps) {
    for (int column = 0; column < 4; ++column)
        for (int axis = 0; axis < 2; ++axis)
            m[column][axis] += steps[axis] * (2.0F / side / 256.0F) * m[column][3];
    return m;
}

/// Particles on an NVIDIA whose viewport rounds in a way that nobody knows, and small triangles beside them.
struct Setting {
    RandomScene scene;
    Profile profile = named_profile("nvidia");
    Mesh obstacles;

    explicit Setting(std::size_t particles) : scene(random_scene(71, particles, side, side)) {
        scene.params.switches = preset("corrected");
    }

    /// Triangles side by side, which together fill a part of the image.
    void add_triangles() {
        Random random(5);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const glm::vec3 corner(static_cast<float>(x) * 0.045F - 0.9F + random.between(0.0F, 0.008F),
                                       static_cast<float>(y) * 0.045F - 1.1F + random.between(0.0F, 0.008F), -0.2F);
                for (const glm::vec2 to : {glm::vec2(0.0F), glm::vec2(0.03F, 0.0F), glm::vec2(0.0F, 0.03F)}) {
                    obstacles.indices.push_back(static_cast<std::uint32_t>(obstacles.positions.size()));
                    obstacles.positions.push_back(corner + glm::vec3(to, 0.0F));
                }
            }
        scene.params.switches.obstacles_in_cdt = ObstaclesInCdt::triangles;
    }

    /// Leaves to `gpu` what it covers, with the codes that the shader computes by itself of where the triangles are.
    void store_unshifted(const CollisionImage& reference, CollisionImage& gpu) const {
        std::vector<std::size_t> gained;
        for (std::size_t i = 0; i < gpu.texels.size(); ++i)
            if (gpu.texels[i].a != 0.0F && reference.texels[i].a != 0.0F)
                gpu.texels[i] = reference.texels[i];
            else if (gpu.texels[i].a != 0.0F)
                gained.push_back(i);
        const auto legal = legal_texels(obstacles, {}, {}, scene.params, profile, {}, gained);
        for (std::size_t i = 0; i < gained.size(); ++i)
            gpu.texels[gained[i]] = legal[i].owners.front().code;
    }

    [[nodiscard]] CollisionImage drawn(const FrameParams& params, const Profile& driver) const {
        CollisionImage cdt = empty_cdt(params);
        DepthImage depth(side, side, 1.0F);
        obstacle_pass(obstacles, params, driver, cdt, depth);
        rasterise_particles(scene.particles, scene.particles, params, driver, cdt, depth);
        return cdt;
    }

    /// What is said of a driver that rounds as `viewport` says, and draws so many 1/256 pixels off.
    [[nodiscard]] VerdictSummary judged(glm::vec2 steps, ViewportRounding viewport = ViewportRounding::scaled) const {
        const KnownOperations known = measured_operations(profile);
        FrameParams off = scene.params;
        off.collision_proj_view = shifted(off.collision_proj_view, steps);
        Profile driver = profile;
        driver.raster.viewport = driver.raster.vertex_viewport = viewport;
        const CollisionImage reference = drawn(scene.params, profile);
        CollisionImage gpu = drawn(off, driver);
        if (!obstacles.indices.empty())
            store_unshifted(reference, gpu);
        const JudgedFrame frame{obstacles, scene.params,    profile,   known,           scene.particles,
                                scene.cdt, scene.particles, reference, scene.particles, gpu};
        const FrameVerdicts verdicts = judge(frame);
        VerdictSummary summary(collision_schema());
        summary.judges_leans = can_judge_leans(known, profile);
        summary.add(0, collision::particles, verdicts.particles);
        summary.add(0, collision::cdt, verdicts.texels);
        summary.first = first_of(DifferenceClass::divergent, 0, frame, verdicts);
        summary.first_beyond_rounding = first_tie_beyond_rounding(0, frame, verdicts);
        summary.convict_shift();
        return summary;
    }
};

std::string shift_of(const VerdictSummary& summary) {
    return verdict_json(summary, collision_schema(), extents)["lean"]["shift"];
}

const std::pair<glm::vec2, const char*> shifts[] = {{{0.4F, 0.0F}, "shifted_right"},
                                                    {{-0.4F, 0.0F}, "shifted_left"},
                                                    {{0.0F, 0.4F}, "shifted_up"},
                                                    {{0.0F, -0.4F}, "shifted_down"},
                                                    {{0.4F, -0.4F}, "shifted_right_and_down"}};

} // namespace

TEST_CASE("tie bias: points shifted by 0.4 of a sub-pixel step are divergent, and the shift has a name") {
    const Setting setting(40'000);
    for (const auto& [steps, name] : shifts) {
        INFO(name);
        const VerdictSummary summary = setting.judged(steps);
        CHECK(summary.total(DifferenceClass::divergent) > 20);
        CHECK(shift_of(summary) == name);
        CHECK_THAT(verdict_text(summary, collision_schema(), extents),
                   Catch::Contains("\nshift     " + std::string(name) + ": "));
        REQUIRE(summary.first);
        const std::string& step = summary.first->wrong.step;
        CHECK((step == "window position" || step == "texel")); // the one it left, empty now
    }
}

TEST_CASE("tie bias: triangles shifted by 0.4 of a sub-pixel step are divergent, and the shift has a name") {
    Setting setting(0);
    setting.add_triangles();
    for (const auto& [steps, name] : shifts) {
        INFO(name);
        const VerdictSummary summary = setting.judged(steps);
        CHECK(summary.total(DifferenceClass::divergent) > 20);
        INFO(verdict_text(summary, collision_schema(), extents));
        CHECK(shift_of(summary) == name);
    }
}

TEST_CASE("tie bias: a driver that rounds otherwise is legal, and nothing lies further than rounding") {
    const Setting setting(200'000);
    Setting triangles(0);
    triangles.add_triangles();
    for (const ViewportRounding viewport :
         {ViewportRounding::separate, ViewportRounding::fused, ViewportRounding::scaled}) {
        for (const Setting* each : {&setting, &std::as_const(triangles)}) {
            const VerdictSummary summary = each->judged({0.0F, 0.0F}, viewport);
            CHECK(summary.total(DifferenceClass::divergent) == 0);
            CHECK(shift_of(summary).empty());
            for (const auto d : {Leans::left, Leans::right, Leans::down, Leans::up})
                CHECK(summary.leans.beyond_rounding(d) == 0);
        }
    }
}

TEST_CASE("tie bias: where nobody measured how accurate window coordinates are, a one-sided lean convicts") {
    Setting setting(150'000);
    setting.profile.point_window_accurate = setting.profile.corner_window_accurate = {};
    for (const auto& [steps, name] : shifts) {
        INFO(name);
        const VerdictSummary summary = setting.judged(steps);
        CHECK(summary.convicted_shift() == name);
        CHECK(summary.total(DifferenceClass::divergent) > 100);
        REQUIRE(summary.first);
        CHECK(summary.first->verdict.kind == DifferenceClass::divergent);
        CHECK_THAT(verdict_text(summary, collision_schema(), extents),
                   Catch::Contains(std::string(name) + ": in both halves of the image"));
    }
    CHECK(setting.judged({0.0F, 0.0F}, ViewportRounding::separate).total(DifferenceClass::divergent) == 0);
}

TEST_CASE("tie bias: a driver measured to be less accurate, or on no known grid, may lean") {
    Setting setting(150'000);
    setting.profile.point_window_accurate = false;
    CHECK(setting.judged({0.4F, 0.0F}).total(DifferenceClass::divergent) == 0);
    setting.profile = named_profile("nvidia");
    setting.profile.not_followed.emplace_back("points: snap");
    const VerdictSummary summary = setting.judged({0.4F, 0.0F});
    CHECK(summary.total(DifferenceClass::divergent) == 0);
    CHECK(shift_of(summary).empty());
    CHECK_THAT(verdict_text(summary, collision_schema(), extents),
               Catch::Contains("\nlean      into the pixel beside: 0 left, "));
}

TEST_CASE("tie bias: a lean counts in both halves, and a place once") {
    const auto lean = [](bool right_half, std::uint64_t place) {
        return Lean{.direction = {1, 0}, .right_half = right_half, .place = place};
    };
    Leans leans;
    for (std::uint64_t i = 0; i < 65; ++i)
        leans.add(lean(false, i));
    CHECK_FALSE(leans.one_sided(Leans::right));
    for (std::uint64_t i = 0; i < 64; ++i)
        leans.add(lean(true, 100 + i));
    for (int again = 0; again < 5; ++again)
        leans.add(lean(true, 100));
    CHECK(leans.count(Leans::right) == 129);
    CHECK_FALSE(leans.one_sided(Leans::right)); // 2^-64 of the right half is not less than 2^-64
    leans.add(lean(true, 200));
    CHECK(leans.one_sided(Leans::right));
    CHECK_FALSE(leans.one_sided(Leans::left));
}

} // namespace lockstep::test::tie_bias_test
