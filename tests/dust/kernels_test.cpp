#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "crosscheck/dust/scene.hpp"
#include "tests/dust/dust_run.hpp"
#include "tests/shaders_with.hpp"

namespace lockstep::test::kernels_test {

namespace dust = lockstep::dust;

namespace {

/// Few grains in a room with everything in it.
dust::Settings room(std::size_t count = 4000) {
    dust::Settings s;
    s.count = count;
    s.spawn = {{-20.0F, 0.0F, -20.0F}, {20.0F, 20.0F, 20.0F}};
    s.world = {{-20.0F, 0.0F, -20.0F}, {20.0F, 20.0F, 20.0F}};
    return s;
}

/// Both arithmetics: not a bit differs.
void expect_agreement(const dust::Settings& settings, int frames) {
    for (const dust::Settings& s : {settings, in_exact(settings)}) {
        const CheckReport report = run_dust(s, frames);
        INFO(report_text(report, {}));
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.untried.empty());
        const CheckReport free = run_dust(s, frames, CheckMode::free);
        CHECK(free.verdict == Verdict::agree);
    }
}

} // namespace

TEST_CASE("dust: a driver that multiplies by a constant's reciprocal is legal where its row says so, and not where the "
          "row says that it divides") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s = dust::load_scene("data/scenes/dust/cube_limit.json", {.particles = 60'000});
    s.tools[0] = {
        .kind = dust::Tool::Kind::vacuum, .from = 0, .to = 2, .range = 1000.0F, .angle = 90.0F, .death_range = 1000.0F};
    s.tools[1].from = 2;
    const dust::HostPtr host = host_of(s);
    const System system = dust::system(host);
    const auto check_with = [&](const std::string& divisor, std::vector<std::string> not_followed) {
        const TemporaryFolder shaders;
        copy_replacing("shaders/dust", shaders, "emit.comp", "ls_divide(seed_of_ray, 82801.277)",
                       "mul(seed_of_ray, 1.0 / " + divisor + ")");
        OtherDriver side(system, dust::passes(host), shaders.path(),
                         [&](Profile& profile) { profile.not_followed = not_followed; });
        CheckOptions options;
        options.frames = 8;
        return check(system, side, options);
    };
    const CheckReport open = check_with("82801.277", {"compute: a/c, c constant"});
    INFO(report_text(open, {}));
    CHECK(open.verdict == Verdict::legal);
    const CheckReport any_factors =
        check_with("82801.277", {"compute: a/c, c constant", "compute: v*s*t, in functions"});
    CHECK(any_factors.verdict == Verdict::legal); // sets that go around the circle are no reason to say undefined
    CHECK(check_with("82801.277", {}).verdict == Verdict::divergent);
    CHECK(check_with("82801.3", {"compute: a/c, c constant"}).verdict == Verdict::divergent);
}

TEST_CASE(
    "dust: what a kernel diverges in by another order of its sums has the rule by which it is legal, and what is wrong "
    "has none") {
    if (!gl())
        return skip(gl().missing());
    const dust::HostPtr host = host_of(dust::load_scene("data/scenes/dust/cube_limit.json", {.particles = 2000}));
    const System system = dust::system(host);
    const auto with_sum = [&](const std::string& sum) {
        const TemporaryFolder shaders;
        copy_replacing("shaders/dust", shaders, "dust.glsl", "add(add(mul(v.x, v.x), mul(v.y, v.y)), mul(v.z, v.z))",
                       sum);
        return run_system(system, dust::passes(host), shaders.path(), host->settings().arithmetic, 8,
                          CheckMode::resync);
    };
    const CheckReport other_order = with_sum("add(mul(v.x, v.x), add(mul(v.y, v.y), mul(v.z, v.z)))");
    INFO(report_text(other_order, {}));
    CHECK(other_order.verdict == Verdict::divergent);
    CHECK(other_order.wider_rule);
    CHECK(report_text(other_order, {}).find("\nhint ") != std::string::npos);
    const CheckReport wrong = with_sum("add(add(mul(v.x, v.x), mul(v.y, v.y)), v.z)");
    CHECK(wrong.verdict == Verdict::divergent);
    CHECK_FALSE(wrong.wider_rule);
}

TEST_CASE("dust: a mistake that shows in few of the grains that differ gets no hint") {
    if (!gl())
        return skip(gl().missing());
    const dust::HostPtr host = host_of(dust::load_scene("data/scenes/dust/free_fall.json", {.particles = 1000}));
    const TemporaryFolder shaders;
    copy_replacing("shaders/dust", shaders, "random.glsl", "int j = (int(mul(size, 1.27323954473516)) + 1) & ~1;",
                   "int j = int(mul(size, 1.27323954473516)) & ~1;");
    const CheckReport report = run_system(dust::system(host), dust::passes(host), shaders.path(),
                                          host->settings().arithmetic, 30, CheckMode::resync);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::divergent);
    CHECK_FALSE(report.wider_rule);
}

TEST_CASE("dust: names bound beside a file that shipped kernels include hold in these kernels, too") {
    if (!gl())
        return skip(gl().missing());
    const dust::HostPtr host = host_of(room(500));
    const TemporaryFolder shaders;
    std::ostringstream text;
    text << std::ifstream("shaders/dust/dust.glsl").rdbuf();
    const std::string shipped = text.str(), block = "velocityBuffer";
    REQUIRE(shipped.find(block) != std::string::npos);
    shaders.write("dust.glsl", std::string(shipped).replace(shipped.find(block), block.size(), "Speeds"));
    const auto run = [&] {
        return run_system(dust::system(host), dust::passes(host), shaders.path(), host->settings().arithmetic, 4,
                          CheckMode::resync);
    };
    CHECK_THROWS_WITH(run(), Catch::Contains("nothing is given for storage block Speeds"));
    shaders.write("bindings.json", R"({ "storage_blocks": { "Speeds": "velocityBuffer" } })");
    CHECK(run().verdict == Verdict::agree);
}

TEST_CASE("dust: grains fall, bounce off the walls and lie, as their twins do") {
    if (!gl())
        return skip(gl().missing());
    expect_agreement(room(), 90);
}

TEST_CASE("dust: spheres and turned boxes, hit and started in, overlapping too") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s = room();
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F},
                   {.position = {4.0F, 3.0F, 0.0F}, .radius = 3.0F},
                   {.sphere = false, .position = {-10.0F, 3.0F, 0.0F}, .scale = {4, 1, 2}, .rotate = {30, 20, 45}},
                   {.sphere = false, .position = {10.0F, 6.0F, 8.0F}, .scale = {6, 2, 9}, .rotate = {0, 70, 0}}};
    s.switches.one_hit = GENERATE(dust::OffOn::on, dust::OffOn::off);
    expect_agreement(s, 60);
}

TEST_CASE("dust: axis-aligned boxes, by both ways to find a touch and to cast on a face") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s = room();
    s.switches.box_kind = dust::BoxKind::aabb;
    s.switches.box_detect = GENERATE(dust::BoxDetect::rounded, dust::BoxDetect::boxed);
    s.switches.plane_cast = GENERATE(dust::PlaneCast::ratio, dust::PlaneCast::normalized);
    s.colliders = {{.sphere = false, .position = {0.0F, 3.0F, 0.0F}, .scale = {8, 4, 6}},
                   {.sphere = false, .position = {10.0F, 6.0F, 8.0F}, .scale = {6, 2, 9}}};
    expect_agreement(s, 60);
}

TEST_CASE("dust: the vacuum, the emitter and the wind one after the other, and the count all along") {
    if (!gl())
        return skip(gl().missing());
    using Kind = dust::Tool::Kind;
    dust::Settings s = room();
    s.controller = {{0, {0.0F, 2.0F, 0.0F}, {0.0F, 0.1F, 1.0F}}, {90, {5.0F, 8.0F, -5.0F}, {1.0F, 0.2F, 1.0F}}};
    s.tools = {{.kind = Kind::vacuum, .from = 0, .to = 50, .force = 30.0F, .range = 25.0F},
               {.kind = Kind::emit, .from = 50, .to = 80, .force = 50.0F, .angle = 30.0F, .distance = 10.0F},
               {.kind = Kind::wind, .from = 80, .to = 110, .force = 20.0F, .range = 25.0F}};
    s.switches.kernel_order = GENERATE(dust::KernelOrder::tools_first, dust::KernelOrder::update_first);
    expect_agreement(s, 120);
}

TEST_CASE("dust: balls of the cannon explode on colliders and walls") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s = room();
    s.colliders = {{.position = {0.0F, 5.0F, 8.0F}, .radius = 3.0F}};
    for (int k = 0; k < 4; ++k)
        s.cannon.push_back(
            {.frame = 10 * k, .position = {0.0F, 5.0F, -10.0F}, .forward = {0.1F * static_cast<float>(k), 0.2F, 1.0F}});
    expect_agreement(s, 120);
}

TEST_CASE("dust: every version of the source agrees with its twins") {
    if (!gl())
        return skip(gl().missing());
    using Kind = dust::Tool::Kind;
    const std::string stage = GENERATE("s1", "s2_lerp", "s2_step", "s2_gpu", "s3", "s4", "s5", "s6", "s7", "s8", "s9",
                                       "s10", "sRE", "s11", "s12", "s13", "s14", "s15", "s16", "sTS", "s17");
    dust::Settings s = room();
    s.switches = dust::stage(stage, s.switches);
    s.tools = {{.kind = Kind::vacuum, .from = 0, .to = 30, .force = 10.0F, .range = 15.0F},
               {.kind = Kind::emit, .from = 30, .to = 50, .force = 20.0F, .angle = 30.0F, .distance = 2.0F}};
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F},
                   {.sphere = false, .position = {-10.0F, 3.0F, 0.0F}, .scale = {4, 1, 2}}};
    INFO(stage);
    expect_agreement(s, 60);
}

TEST_CASE("dust: remedies agree with their twins") {
    if (!gl())
        return skip(gl().missing());
    using Kind = dust::Tool::Kind;
    dust::Settings s = room();
    s.switches.clamp_velocity = dust::ClampVelocity::zero;
    s.switches.root = dust::Root::clamp;
    s.switches.side_exit = dust::SideExit::keep;
    s.switches.emit_disc = dust::EmitDisc::even;
    s.switches.drag_step = dust::DragStep::implicit;
    s.switches.drag = dust::Drag::by_mass;
    s.mass = 1.5F;
    s.tools = {{.kind = Kind::vacuum, .from = 0, .to = 30, .force = 30.0F, .range = 15.0F},
               {.kind = Kind::emit, .from = 30, .to = 50, .force = 20.0F, .angle = 30.0F, .distance = 2.0F}};
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F}};
    expect_agreement(s, 60);
}

TEST_CASE("dust: of the driver's own sine every number is legal, and a wrong kernel is divergent beside it") {
    if (!gl())
        return skip(gl().missing());
    using Kind = dust::Tool::Kind;
    dust::Settings s = room(1000);
    s.switches = dust::preset("paper");
    s.tools = {{.kind = Kind::vacuum, .from = 0, .to = 20, .force = 30.0F, .range = 25.0F}};
    const CheckReport report = run_dust(s, 60);
    INFO(report_text(report, {}));
    CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
    const bool follows = gl().name().find("llvmpipe") != std::string::npos && __builtin_cpu_supports("fma") != 0 &&
                         std::getenv("GALLIUM_OVERRIDE_CPU_CAPS") == nullptr;
    if (follows)
        CHECK(report.verdict == Verdict::agree);
    s.gravity.y = -9.0F;
    const dust::HostPtr right = host_of(s);
    s.gravity.y = -9.8F;
    const dust::HostPtr wrong = host_of(s);
    const System system = dust::system(right);
    GlSystemSide side(gl(), system, dust::passes(wrong), "shaders/dust");
    CHECK(check(system, side, {}).verdict == Verdict::divergent);
}

TEST_CASE("dust: the last group's idle threads write nothing") {
    if (!gl())
        return skip(gl().missing());
    expect_agreement(room(GENERATE(std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{65})), 10);
}

} // namespace lockstep::test::kernels_test
