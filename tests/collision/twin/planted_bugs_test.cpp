#include <cstring>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "reference/model/collision/collision_state.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::planted_bugs_test {

namespace {

constexpr int frames = 16;

/// Adds a particle that flies with speed 1, or rests but for a trace that keeps its direction a number.
void add(Particles& particles, glm::vec3 position, glm::vec3 direction, bool flies) {
    particles.position.push_back(position);
    particles.direction.push_back(glm::normalize(direction));
    particles.speed.push_back(flies ? 1.0F : 0.001F);
    particles.collide_time.push_back(0.0F);
}

/// Groups of one particle that flies along x towards two that rest beside its way, and pairs on one line of sight, the
/// one behind flying towards the one in front. Nothing collides in the first frames; after a hit a particle all but
/// stops, within reach of the others.
Scene approaching_scene() {
    test::RandomScenes random(5);
    Scene scene;
    scene.name = "approaching";
    for (int y = -4; y <= 4; ++y)
        for (int x = -3; x <= 3; ++x) {
            const glm::vec3 middle(0.28F * static_cast<float>(x), 0.2F * static_cast<float>(y), 0.0F);
            const glm::vec3 ahead(1.0F, 0.0F, 0.0F);
            const glm::vec3 aside(0.0F, 0.035F, 0.0F);
            const float away = 0.11F + 0.01F * static_cast<float>(x + 3);
            add(scene.start, middle - away * ahead + random.position(0.02F), ahead, true);
            add(scene.start, middle - aside + random.position(0.008F), ahead, false);
            add(scene.start, middle + aside + random.position(0.008F), ahead, false);
            const glm::vec3 front = middle + glm::vec3(0.1F, 0.1F, 0.3F) + random.position(0.02F);
            const glm::vec3 sight = glm::normalize(scene.camera.eye - front);
            add(scene.start, front, sight, false);
            add(scene.start, front - 0.2F * sight, sight, true);
        }
    scene.width = 97;
    scene.height = 101;
    scene.constants.tick = 1.0F / 64.0F;
    scene.constants.gravity = {0.0F, -1e-3F, 0.0F};
    scene.constants.collision_range = 0.05F;
    scene.constants.collision_time = 3.0F / 64.0F;
    scene.constants.texel_collide_range = 2;
    scene.switches.speed_factor = 1.0F / 1024.0F;
    return scene;
}

struct State {
    Particles particles;
    CollisionImage cdt;

    bool operator==(const State& other) const {
        const auto same = [](const auto& a, const auto& b) {
            return std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
        };
        return same(particles.position, other.particles.position) &&
               same(particles.direction, other.particles.direction) && same(particles.speed, other.particles.speed) &&
               same(particles.collide_time, other.particles.collide_time) && same(cdt.texels, other.cdt.texels);
    }
};

State step(GpuSimulation& gpu, const State& from, const FrameParams& params) {
    State to;
    gpu.upload(from.particles, from.cdt);
    gpu.step(params);
    gpu.read(to.particles);
    gpu.read(to.cdt);
    return to;
}

/// What a planted shader is to be caught at, without the reference: the first frame it answers otherwise than the
/// shipped one, from the state the shipped one has come to.
int first_wrong_frame(const Scene& scene, const std::filesystem::path& planted) {
    GpuSimulation right(scene, {});
    GpuSimulation wrong(scene, planted);
    State state{scene.start, CollisionImage(scene.width, scene.height)};
    for (int frame = 0; frame < frames; ++frame) {
        const FrameParams params = frame_params(scene, frame);
        State next = step(right, state, params);
        if (!(step(wrong, state, params) == next))
            return frame;
        state = std::move(next);
    }
    return frames;
}

/// The first frame in which the shipped shader finds a collision.
int first_hit_frame(const Scene& scene) {
    GpuSimulation gpu(scene, {});
    State state{scene.start, CollisionImage(scene.width, scene.height)};
    for (int frame = 0; frame < frames; ++frame) {
        state = step(gpu, state, frame_params(scene, frame));
        for (const float time : state.particles.collide_time)
            if (time == scene.constants.collision_time)
                return frame;
    }
    return frames;
}

/// Where the first wrong frame lies by reasoning.
enum class When { start, first_hit, any_hit, four_after_first_hit };

struct Bug {
    const char* name;
    const char* file;
    const char* text;
    const char* replacement;
    When when;
    const char* cause; ///< its name in reference/collision/deviation.hpp; empty: it has none
};

constexpr Bug bugs[] = {
    {"the last neighbour instead of the nearest", "collision_pass.vert",
     "if (u_CollisionRange > len && len < particle_min_length)", "if (u_CollisionRange > len)", When::any_hit,
     "last_found_instead_of_nearest"},
    // A hit sets 3 ticks, which have run out to exactly 0 at the start of the fourth frame after it.
    {"searching at collide time 0", "collision_pass.vert", "ls_flush(a_CollideTime) < 0.0 &&",
     "ls_flush(a_CollideTime) <= 0.0 &&", When::four_after_first_hit, "collide_time_zero_searches"},
    {"one column of neighbours too few", "collision_pass.vert", "tx <= u_TexelCollideRange; ++tx",
     "tx < u_TexelCollideRange; ++tx", When::any_hit, "last_column_skipped"},
    {"twice the speed factor", "collision_pass.vert", "product(a_Speed, u_SpeedFactor)",
     "product(a_Speed, 2.0 * u_SpeedFactor)", When::first_hit, "speed_factor_doubled"},
    {"a hit's step without the tick", "collision_pass.vert", "    step = product(step, u_Tick);\n", "", When::first_hit,
     "tick_missing_in_collision_step"},
    {"the image upside down", "base_texel.glsl", "tex_coord.y * float(u_ClientHeight)",
     "(1.0 - tex_coord.y) * float(u_ClientHeight)", When::any_hit, "y_flipped"},
    {"half a texel off", "base_texel.glsl", "texel = ivec2(scaled);", "texel = ivec2(scaled + 0.5);", When::any_hit,
     "half_texel_up"},
    {"collide time not counted", "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;", "ls_flush(a_CollideTime);",
     When::start, "collide_time_not_counted"},
    {"the own texel not skipped", "collision_pass.vert", "(tx == 0 && ty == 0) || !on_image(texel)", "!on_image(texel)",
     When::any_hit, "own_texel_not_skipped"},
    {"speed one ULP too high", "collision_pass.vert", "v_Speed = ls_length(temp);",
     "v_Speed = uintBitsToFloat(floatBitsToUint(ls_length(temp)) + 1u);", When::start, ""},
};

bool fits(When when, int frame, int first_hit) {
    switch (when) {
    case When::start:
        return frame == 0;
    case When::first_hit:
        return frame == first_hit;
    case When::any_hit:
        return frame >= first_hit && frame < frames;
    case When::four_after_first_hit:
        return frame == first_hit + 4;
    }
    return false;
}

} // namespace

TEST_CASE("planted bugs: each is found, in the frame in which it first shows, by its name") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = approaching_scene();
    const int first_hit = first_hit_frame(scene);
    REQUIRE(first_hit >= 2);
    REQUIRE(first_hit + 4 < frames);
    for (const Bug& bug : bugs) {
        INFO(bug.name);
        const test::TemporaryFolder shaders;
        test::plant(shaders, bug.file, bug.text, bug.replacement);
        const int expected = first_wrong_frame(scene, shaders.path());
        CAPTURE(first_hit, expected);
        CHECK(fits(bug.when, expected, first_hit));
        const CheckReport report = test::check_twins(scene, frames, shaders.path());
        CHECK(report.verdict == Verdict::divergent);
        CHECK(report.first_frame == expected);
        CHECK(report.worst.front().frame == expected);
        REQUIRE(report.verdicts);
        const CauseFindings& cause = report.verdicts->causes[collision::particles];
        CHECK(cause.explains_all() == (*bug.cause != '\0'));
        CHECK((cause.explains_all() ? cause.best.front().name() : "") == bug.cause);
        CHECK(report.verdicts->first->place.frame == expected);
    }
}

TEST_CASE("planted bugs: with none, the same run agrees") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const CheckReport report = test::check_twins(approaching_scene(), frames);
    CHECK(report.verdict == Verdict::agree);
    CHECK_FALSE(report.first_frame.has_value());
}

} // namespace lockstep::test::planted_bugs_test
