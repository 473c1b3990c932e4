#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "crosscheck/dust/scene.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::failures_test {

/// What goes wrong in the source's demo, with its cause and, where there is one, without.
namespace dust = lockstep::dust;

namespace {

dust::Settings alone(std::size_t count = 1) {
    dust::Settings s;
    s.count = count;
    s.switches.random = dust::Random::integer;
    s.switches.radius_of_scale = 1.0F;
    s.gravity = glm::vec3(0.0F);
    s.air_resistance = 0.0F;
    s.scale = 0.1F;
    s.world = {glm::vec3(-1000.0F), glm::vec3(1000.0F)};
    return s;
}

dust::Tool vacuum(float force = 30.0F, float range = 25.0F) {
    return {.kind = dust::Tool::Kind::vacuum, .from = 0, .to = 10000, .force = force, .range = range};
}

bool is_nan(glm::vec3 v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); }

/// One grain through `frames` of the kernels.
Grains after(const dust::Settings& s, glm::vec3 position, glm::vec3 velocity, std::vector<const char*> kernels,
             int frames, int first = 0) {
    Grains grains(host_of(s));
    grains.place(0, position, velocity);
    for (int frame = first; frame < first + frames; ++frame)
        for (const char* kernel : kernels)
            grains.run(kernel, frame);
    return grains;
}

} // namespace

TEST_CASE("dust failure black_hole: without a cone the vacuum pulls from behind as well") {
    for (const char* stage : {"s2_gpu", "s4"}) {
        dust::Settings s = alone();
        s.switches = dust::stage(stage, s.switches);
        s.tools = {vacuum()};
        const Grains grains = after(s, {0.0F, 0.0F, -5.0F}, {}, {"vacuum_up"}, 1);
        CHECK((grains.position().z > -5.0F) == (stage == std::string("s2_gpu")));
    }
}

TEST_CASE("dust failure cut_billboard: without its radius a grain's quad sinks half into the floor") {
    for (const char* stage : {"s6", "s7"}) {
        dust::Settings s = alone();
        s.gravity = {0.0F, -9.8F, 0.0F};
        s.switches = dust::stage(stage, s.switches);
        const Grains grains = after(s, {0.0F, 1.0F, 0.0F}, {}, {"update"}, 120);
        CHECK(grains.position().y == (stage == std::string("s6") ? 0.0F : s.scale));
    }
}

TEST_CASE("dust failure roll_no_bounce, floor_piles_speed: a floor that only stops positions keeps the speed") {
    dust::Settings s = alone();
    s.gravity = {0.0F, -9.8F, 0.0F};
    s.air_resistance = 1.0F;
    s.switches = dust::stage("s8", s.switches);
    const Grains rolling = after(s, {0.0F, 1.0F, 0.0F}, {}, {"update"}, 1200);
    CHECK(rolling.position().y == s.scale);
    CHECK(rolling.velocity().y == Approx(-9.8F));
    s.switches = dust::stage("s9", s.switches);
    const Grains bouncing = after(s, {0.0F, 1.0F, 0.0F}, {}, {"update"}, 40);
    CHECK(bouncing.velocity().y > 0.0F);
}

TEST_CASE("dust failure overlap_oscillation, wedge_leak: between two overlapping spheres a grain hangs or leaks") {
    dust::Settings s = alone();
    s.gravity = {0.0F, -9.8F, 0.0F};
    s.air_resistance = 1.0F;
    s.switches.world = dust::World::none;
    s.colliders = {{.position = {-3.0F, 0.0F, 0.0F}, .radius = 5.0F}, {.position = {3.0F, 0.0F, 0.0F}, .radius = 5.0F}};
    for (const dust::OffOn one_hit : {dust::OffOn::off, dust::OffOn::on}) {
        s.switches.one_hit = one_hit;
        Grains grains(host_of(s));
        grains.place(0, {0.2F, 6.0F, 0.0F}, {});
        float lowest = 6.0F;
        for (int frame = 0; frame < 1200; ++frame) {
            grains.run("update", frame);
            lowest = std::min(lowest, grains.position().y);
        }
        if (one_hit == dust::OffOn::off)
            CHECK(grains.position().y == Approx(4.1251F).margin(2e-4)); // above the notch, at rest in the air
        else
            CHECK(lowest < 3.0F); // inside both
    }
}

TEST_CASE("dust failure impulse_by_dt: a blast that lasts a frame is a fifth as strong at a fifth of the speed") {
    const auto blown = [](float timescale, dust::ImpulseDt impulse) {
        dust::Settings s = alone();
        s.timescale = timescale;
        s.switches.impulse_dt = impulse;
        s.colliders = {{.radius = 1.0F}};
        s.cannon = {{.frame = 0, .position = {}, .speed = 0.0F, .range = 10.0F}};
        return after(s, {3.0F, 4.0F, 0.0F}, {}, {"explode"}, 1, 1).velocity().x;
    };
    using dust::ImpulseDt;
    CHECK(blown(0.2F, ImpulseDt::frame) == Approx(blown(1.0F, ImpulseDt::frame) * 0.2F));
    CHECK(blown(0.2F, ImpulseDt::constant) == blown(1.0F, ImpulseDt::constant));
}

TEST_CASE("dust failure wind_by_fps, paused_wind: wind of a fixed time grows with the frames, even while time stands") {
    const auto blown = [](float tick, float timescale, int frames, dust::ImpulseDt impulse) {
        dust::Settings s = alone();
        s.tick = tick;
        s.timescale = timescale;
        s.switches.impulse_dt = impulse;
        s.tools = {{.kind = dust::Tool::Kind::wind, .from = 0, .to = 1000, .force = 10.0F, .range = 20.0F}};
        return after(s, {0.0F, 0.0F, 4.0F}, {}, {"blow_wind"}, frames).velocity().z;
    };
    using dust::ImpulseDt;
    CHECK(blown(1.0F / 120.0F, 1.0F, 60, ImpulseDt::constant) ==
          Approx(2.0F * blown(1.0F / 60.0F, 1.0F, 30, ImpulseDt::constant)));
    CHECK(blown(1.0F / 60.0F, 0.0F, 30, ImpulseDt::constant) > 10.0F);
    CHECK(blown(1.0F / 120.0F, 1.0F, 60, ImpulseDt::constant_but_wind) ==
          Approx(blown(1.0F / 60.0F, 1.0F, 30, ImpulseDt::constant_but_wind)));
    CHECK(blown(1.0F / 60.0F, 0.0F, 30, ImpulseDt::constant_but_wind) == 0.0F);
}

TEST_CASE("dust failure tunnel: a fast grain passes a sphere unseen, and the wall throws it into it") {
    dust::Settings s = alone();
    s.elasticity = 0.6F;
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F}};
    s.world = {{-50.0F, 0.0F, -50.0F}, {50.0F, 50.0F, 50.0F}};
    const Grains grains = after(s, {0.0F, 10.0F, 0.0F}, {0.0F, -1200.0F, 0.0F}, {"update"}, 1);
    CHECK(grains.position().y == Approx(6.16F).margin(0.01));
    CHECK(glm::length(grains.position() - glm::vec3(0.0F, 2.5F, 0.0F)) < 5.0F);
}

TEST_CASE("dust failure zero_ray_nan, nan_forever: at rest in a collider a grain becomes NaN, and stays alive as one") {
    dust::Settings s = alone();
    s.arithmetic = ArithmeticSwitch::exact;
    s.colliders = {{.radius = 5.0F}};
    s.tools = {vacuum()};
    s.controller = {{0, {0.0F, 0.0F, -3.0F}, {0.0F, 0.0F, 1.0F}}};
    const Grains grains = after(s, {1.0F, 0.0F, 0.0F}, {}, {"update", "vacuum_up"}, 3);
    CHECK(is_nan(grains.position()));
    CHECK(is_nan(grains.velocity()));
    CHECK(grains.alive() == 1);
    CHECK(grains.count() == 1);
}

TEST_CASE("dust failure explode_centre_nan: a grain at the very blast becomes NaN") {
    dust::Settings s = alone();
    s.arithmetic = ArithmeticSwitch::exact;
    s.colliders = {{.radius = 1.0F}};
    s.cannon = {{.frame = 0, .position = {}, .speed = 0.0F, .range = 10.0F}};
    CHECK(is_nan(after(s, {}, {}, {"explode"}, 1, 1).velocity()));
    CHECK_FALSE(is_nan(after(s, {0.001F, 0.0F, 0.0F}, {}, {"explode"}, 1, 1).velocity()));
}

TEST_CASE("dust failure mouth_zero: a grain at the very mouth is saved by a comparison with NaN") {
    for (const char* kernel : {"vacuum_up", "blow_wind"}) {
        dust::Settings s = alone();
        s.arithmetic = ArithmeticSwitch::exact;
        s.tools = {vacuum()};
        if (kernel == std::string("blow_wind"))
            s.tools[0].kind = dust::Tool::Kind::wind;
        const Grains grains = after(s, {}, {1.0F, 2.0F, 3.0F}, {kernel}, 1);
        CHECK(grains.velocity() == glm::vec3(1.0F, 2.0F, 3.0F));
        CHECK(grains.alive() == 1);
    }
}

TEST_CASE("dust failure side_exit_kill: a grain that is pulled out of the cone's side dies, unless kept") {
    for (const dust::SideExit exit : {dust::SideExit::kill, dust::SideExit::keep}) {
        dust::Settings s = alone();
        s.switches.side_exit = exit;
        s.tools = {vacuum(1.0F)};
        const Grains grains = after(s, {3.9F, 0.0F, 4.0F}, {60.0F, 0.0F, 0.0F}, {"vacuum_up"}, 1);
        CHECK(grains.alive() == (exit == dust::SideExit::keep ? 1 : 0));
    }
}

TEST_CASE("dust failure corner_escape: of two walls crossed at once only the first is answered") {
    dust::Settings s = alone();
    s.elasticity = 1.0F;
    s.world = {glm::vec3(-50.0F), glm::vec3(50.0F)};
    const Grains one = after(s, {49.0F, 49.0F, 0.0F}, {120.0F, 120.0F, 0.0F}, {"update"}, 1);
    CHECK(one.position().x < 50.0F);
    CHECK(one.position().y == Approx(51.0F));
    const Grains two = after(s, {49.0F, 49.0F, 0.0F}, {120.0F, 120.0F, 0.0F}, {"update"}, 2);
    CHECK(two.position().y == 49.9F);
    CHECK(two.velocity().y == 120.0F);
    s.switches.clamp_velocity = dust::ClampVelocity::zero;
    const Grains remedied = after(s, {49.0F, 49.0F, 0.0F}, {120.0F, 120.0F, 0.0F}, {"update"}, 2);
    CHECK(remedied.velocity().y == 0.0F);
}

TEST_CASE("dust failure drag_blowup: drag of a hundred at thirty frames a second is infinite after 98 frames") {
    dust::Settings s = alone();
    s.tick = 1.0F / 30.0F;
    s.air_resistance = 100.0F;
    s.switches.world = dust::World::none;
    Grains grains(host_of(s));
    grains.place(0, {}, {0.0F, -9.8F, 0.0F});
    int frame = 0;
    while (std::isfinite(grains.velocity().y) && frame < 300)
        grains.run("update", frame++);
    CHECK(frame < 140);
    s.switches.drag_step = dust::DragStep::implicit;
    CHECK(std::abs(after(s, {}, {0.0F, -9.8F, 0.0F}, {"update"}, 100).velocity().y) < 1e-6F);
}

TEST_CASE("dust failure angle_90: the tangent of a float's right angle is huge, negative and mirrors the emitter") {
    dust::Settings s = alone();
    s.tools = {{.kind = dust::Tool::Kind::emit, .from = 0, .to = 10, .angle = 90.0F}};
    CHECK(host_of(s)->at(0).tangent == -22877332.0F);
}

TEST_CASE("dust failure static_spray: a grain leaves in the same direction every time") {
    dust::Settings s = alone(500);
    s.tools = {{.kind = dust::Tool::Kind::emit, .from = 0, .to = 1000, .force = 5.0F, .angle = 30.0F}};
    Grains grains(host_of(s));
    std::vector<glm::vec3> first(s.count);
    std::size_t again = 0;
    for (int frame = 0; frame < 400; ++frame) {
        for (std::size_t i = 0; i < s.count; ++i) {
            if (grains.alive(i) == 1 && first[i] == glm::vec3(0.0F))
                first[i] = grains.velocity(i);
            else if (grains.alive(i) == 1) {
                ++again;
                CHECK(grains.velocity(i) == first[i]);
            }
            grains.state.set(dust::field::alive, i, std::int32_t{0});
        }
        grains.run("emit", frame);
    }
    CHECK(again > 100);
}

TEST_CASE("dust failure stale_collider: the removed last collider is a box of zeros that hits every grain") {
    dust::Settings s = alone();
    s.arithmetic = ArithmeticSwitch::exact;
    s.colliders = {{.sphere = false, .removed = true}};
    for (const dust::LastCollider left : {dust::LastCollider::zeros, dust::LastCollider::none}) {
        s.switches.last_collider = left;
        const Grains grains = after(s, {30.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, {"update"}, 1);
        CHECK((grains.velocity() == glm::vec3(1.0F, 2.0F, 0.0F)) == (left == dust::LastCollider::none));
    }
}

TEST_CASE("dust failure fifth_collider: as many colliders as one likes") {
    dust::Settings s = alone();
    for (int k = 0; k < 9; ++k)
        s.colliders.push_back({.position = {10.0F * static_cast<float>(k), 0.0F, 0.0F}, .radius = 1.0F});
    const Grains grains = after(s, {80.0F, 2.0F, 0.0F}, {0.0F, -60.0F, 0.0F}, {"update"}, 1);
    CHECK(grains.velocity().y > 0.0F);
}

TEST_CASE("dust failure count: it is the number alive after every kernel, in every version of the suction") {
    dust::Settings s;
    s.count = 600;
    s.spawn = {{-6.0F, 0.0F, -6.0F}, {6.0F, 6.0F, 6.0F}};
    s.world = s.spawn;
    s.tools = {vacuum(20.0F, 20.0F),
               {.kind = dust::Tool::Kind::emit, .from = 0, .to = 0, .force = 5.0F, .angle = 30.0F}};
    s.tools[0].to = 40;
    s.tools[1].from = 40;
    s.tools[1].to = 80;
    for (const char* stage : {"s2_lerp", "s2_step", "s4", "s5", "sRE", "s17"}) {
        INFO(stage);
        s.switches = dust::stage(stage, dust::preset("exact"));
        const dust::HostPtr host = host_of(s);
        const System system = dust::system(host);
        const Profile strict = named_profile("strict");
        SystemState state = system.start;
        std::uint32_t least = 600;
        for (int frame = 0; frame < 80; ++frame)
            for (const auto& pass : system.passes) {
                const SystemState before = state;
                run_pass(*pass, {before.view(), frame}, strict, state[pass->resource()]);
                if (pass->resource() != dust::count_buffer)
                    continue;
                std::uint32_t living = 0;
                for (std::size_t i = 0; i < s.count; ++i)
                    living += state.view().word(dust::field::alive, i);
                const std::uint32_t count = state.view().word(dust::field::alive_number, 0);
                CHECK(count == living);
                least = std::min(least, count);
            }
        CHECK(least < 600);
    }
}

TEST_CASE("dust failure corner_escape: with all walls answered the grain stays inside") {
    dust::Settings s = alone();
    s.elasticity = 1.0F;
    s.world = {glm::vec3(-50.0F), glm::vec3(50.0F)};
    s.switches.walls = dust::Walls::all;
    const Grains grains = after(s, {49.0F, 49.0F, 0.0F}, {120.0F, 120.0F, 0.0F}, {"update"}, 1);
    CHECK(grains.position().x < 50.0F);
    CHECK(grains.position().y < 50.0F);
    CHECK(grains.velocity().y == -120.0F);
}

TEST_CASE("dust failure zero_ray_nan, explode_centre_nan: without a direction there is no force and no NaN, if asked") {
    dust::Settings s = alone();
    s.arithmetic = ArithmeticSwitch::exact;
    s.switches.safe_direction = dust::OffOn::on;
    s.colliders = {{.radius = 5.0F}};
    s.cannon = {{.frame = 0, .position = {}, .speed = 0.0F, .range = 10.0F}};
    CHECK(after(s, {1.0F, 0.0F, 0.0F}, {}, {"update"}, 3).position() == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(after(s, {}, {}, {"explode"}, 1, 1).velocity() == glm::vec3(0.0F));
    s.tools = {vacuum()};
    s.tools[0].angle = 90.0F; // its threshold is below 0
    CHECK(after(s, {}, {1.0F, 2.0F, 3.0F}, {"vacuum_up"}, 1).velocity() == glm::vec3(1.0F, 2.0F, 3.0F));
    s.tools[0].kind = dust::Tool::Kind::wind;
    CHECK(after(s, {}, {1.0F, 2.0F, 3.0F}, {"blow_wind"}, 1).velocity() == glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST_CASE("dust failure start_inside_sphere: pushed out, a grain goes to the nearest surface, not the farthest") {
    for (const dust::Inside inside : {dust::Inside::answer, dust::Inside::push_out}) {
        dust::Settings s = alone();
        s.elasticity = 0.6F;
        s.switches.inside = inside;
        s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F}};
        const Grains grains = after(s, {1.0F, 2.5F, 0.0F}, {6.0F, 0.0F, 0.0F}, {"update"}, 1);
        CHECK(grains.position().x == Approx(inside == dust::Inside::push_out ? 5.1F : -8.82F).margin(1e-4));
        CHECK(grains.velocity().x == Approx(inside == dust::Inside::push_out ? 6.0F : -3.6F));
        const Grains inward = after(s, {1.0F, 2.5F, 0.0F}, {-6.0F, 0.0F, 0.0F}, {"update"}, 1);
        CHECK((inward.velocity().x > 0.0F));
    }
}

TEST_CASE("dust failure static_spray: a grain always leaves in the same direction, unless time draws it as well") {
    for (const dust::Random random : {dust::Random::integer, dust::Random::sin_portable})
        for (const dust::EmitSeed seed : {dust::EmitSeed::index, dust::EmitSeed::index_time}) {
            dust::Settings s = alone(20'000);
            s.switches.random = random;
            s.switches.emit_seed = seed;
            s.tools = {{.kind = dust::Tool::Kind::emit, .from = 0, .to = 10000, .force = 10.0F, .angle = 30.0F}};
            std::size_t twice = 0, same = 0;
            std::vector<glm::vec3> first(s.count, glm::vec3(0.0F));
            for (const int frame : {3, 700, 1400, 2100}) {
                Grains grains(host_of(s));
                for (std::size_t i = 0; i < s.count; ++i)
                    grains.state.set(dust::field::alive, i, std::int32_t{0});
                grains.run("emit", frame);
                for (std::size_t i = 0; i < s.count; ++i) {
                    if (grains.alive(i) == 0)
                        continue;
                    if (first[i] != glm::vec3(0.0F)) {
                        ++twice;
                        same += first[i] == grains.velocity(i) ? 1 : 0;
                    }
                    first[i] = grains.velocity(i);
                }
            }
            REQUIRE(twice > 0);
            CHECK((same == twice) == (seed == dust::EmitSeed::index));
        }
}

TEST_CASE(
    "dust: gravity_dir=down takes gravity's height alone, and div_frac puts a grain beside its place in the row") {
    dust::Settings s = alone(20'000);
    s.gravity = {3.0F, -9.8F, 1.0F};
    s.switches.gravity_dir = dust::GravityDir::down;
    const Grains fallen = after(s, {}, {}, {"update"}, 1);
    CHECK(fallen.velocity().x == 0.0F);
    CHECK(fallen.velocity().y < 0.0F);
    s.spawn = {{-50.0F, 0.0F, -50.0F}, {50.0F, 5.0F, 50.0F}};
    s.switches.random = dust::Random::sin_portable;
    std::vector<glm::vec3> shades[2];
    for (const dust::Modulo modulo : {dust::Modulo::fmod, dust::Modulo::div_frac}) {
        s.switches.modulo = modulo;
        Grains grains(host_of(s));
        grains.run("populate");
        for (std::size_t i = 0; i < s.count; ++i)
            shades[modulo == dust::Modulo::fmod ? 0 : 1].push_back(grains.colour(i));
    }
    CHECK(shades[0] != shades[1]);
}

TEST_CASE(
    "dust box_detect: rounded, a box answers who is a radius from its nearest point; boxed, corners answer, too") {
    // At an edge of the box at +-1 with r 0.1: 0.09 beyond both faces is 0.127 from the edge, 0.07 beyond 0.099.
    for (const float beyond : {1.07F, 1.09F})
        for (const dust::BoxDetect detect : {dust::BoxDetect::rounded, dust::BoxDetect::boxed}) {
            dust::Settings s = alone();
            s.elasticity = 0.5F;
            s.switches.radius_of_scale = 1.0F;
            s.switches.box_kind = dust::BoxKind::aabb;
            s.switches.box_detect = detect;
            s.colliders = {{.sphere = false, .scale = glm::vec3(2.0F)}};
            const glm::vec3 speed(0.0F, -6.0F, 0.0F);
            const Grains grains = after(s, {beyond, beyond + 6.0F * s.tick, 0.0F}, speed, {"update"}, 1);
            const bool answers = detect == dust::BoxDetect::boxed || beyond < 1.08F;
            CHECK((grains.velocity() != speed) == answers);
        }
}

TEST_CASE("dust remedies and readings: the shaders agree with the twins in each") {
    if (!gl())
        return skip(gl().missing());
    const auto with = [](const auto& change) {
        dust::Settings s = dust::load_scene("data/scenes/dust/vacuum_and_back.json", {.particles = 1500});
        s.spawn = {{-10.0F, 0.0F, -10.0F}, {10.0F, 8.0F, 10.0F}};
        s.world = {{-10.0F, 0.0F, -10.0F}, {10.0F, 8.0F, 10.0F}};
        s.tools[0].to = 30;
        s.tools[0].range = 8.0F;
        s.tools[1].from = 30;
        s.elasticity = 1.0F;
        change(s.switches);
        return run_dust(s, 60);
    };
    const CheckReport reports[] = {with([](dust::Switches& s) { s.walls = dust::Walls::all; }),
                                   with([](dust::Switches& s) { s.inside = dust::Inside::push_out; }),
                                   with([](dust::Switches& s) { s.safe_direction = dust::OffOn::on; }),
                                   with([](dust::Switches& s) { s.emit_seed = dust::EmitSeed::index_time; }),
                                   with([](dust::Switches& s) { s.modulo = dust::Modulo::div_frac; }),
                                   with([](dust::Switches& s) { s.gravity_dir = dust::GravityDir::down; })};
    for (const CheckReport& report : reports)
        CHECK(report.verdict == Verdict::agree);
}

} // namespace lockstep::test::failures_test
