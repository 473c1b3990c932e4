#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::kernels_test {

namespace lifecycle = lockstep::lifecycle;

namespace {

/// Particles that fall and die at different ages.
lifecycle::Settings shower(std::size_t capacity = 600) {
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = capacity;
    e.rate = 1500.0;
    e.lifetime = {0.1F, 0.3F};
    e.shape = lifecycle::Emitter::Shape::box;
    e.min = {-1.0F, 0.0F, -1.0F};
    e.max = {1.0F, 0.5F, 1.0F};
    e.direction_jitter = 0.5F;
    e.speed_jitter = 0.25F;
    e.acceleration = {0.0F, -9.8F, 0.0F};
    return s;
}

/// Not a bit differs.
void expect_agreement(const lifecycle::Settings& s, int frames, CheckMode mode = CheckMode::free) {
    const CheckReport report = run_lifecycle(s, frames, mode);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried.empty());
}

} // namespace

TEST_CASE("lifecycle: every layout of the ladder agrees with its twins, on its own way") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = in_exact(shower());
    s.switches.layout = static_cast<lifecycle::Layout>(GENERATE(0, 1, 2, 3, 4, 5, 6));
    expect_agreement(s, 40);
}

TEST_CASE("lifecycle: the codes of packed fields, plain arithmetic, step by step") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = shower();
    s.switches.half_rounding = lifecycle::HalfRounding::dithered;
    s.switches.time_code = lifecycle::TimeCode::half_seconds;
    s.switches.position_code = lifecycle::PositionCode::box16;
    s.switches.color_code = lifecycle::ColorCode::rgb10_a2;
    s.box_low = {-1.0F, -0.2F, -1.0F}; // left by some
    s.box_size = {2.0F, 2.0F, 2.0F};
    expect_agreement(s, 30, CheckMode::resync);
}

TEST_CASE("lifecycle: every force, split and fused, with the source's order of a frame") {
    if (!gl())
        return skip(gl().missing());
    using Kind = lifecycle::Force::Kind;
    lifecycle::Settings s = in_exact(shower());
    s.switches.fuse = GENERATE(lifecycle::Fuse::split, lifecycle::Fuse::fused);
    s.switches.emit_when = lifecycle::EmitWhen::before_destroy;
    s.switches.integration = lifecycle::Integration::ballistic;
    s.switches.drag = lifecycle::Drag::explicit_force;
    s.emitters[0].forces = {{.kind = Kind::drag, .k = 0.8F},
                            {.kind = Kind::vortex, .strength = 2.0F, .radius = 2.0F, .falloff = 2, .pull = 0.5F},
                            {.kind = Kind::attraction, .centre = {0.0F, 0.4F, 0.0F}, .kill_radius = 0.3F},
                            {.kind = Kind::attraction, .strength = 0.5F, .inverse_square = true},
                            {.kind = Kind::curl_noise, .strength = 1.5F, .frequency = 1.7F, .pan = {0, -0.5F, 0}}};
    expect_agreement(s, 20);
}

TEST_CASE("lifecycle: a kernel that writes a buffer which it may only read is told, and which") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "lifecycle");
    plant(folder, "lifecycle/move.comp", "    store(j);\n", "    store(j);\n    counters[u_Emitter].killed = 7u;\n");
    const CheckMode mode = GENERATE(CheckMode::free, CheckMode::resync);
    CHECK_THROWS_WITH(run_lifecycle(shower(), 6, mode, (folder.path() / "lifecycle").string()),
                      Catch::Contains("move changed emitter 0; it must write the particles alone"));
}

TEST_CASE("lifecycle: a kernel that changes the particles it reads is told, not called nondeterministic") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "lifecycle");
    plant(folder, "lifecycle/particles.glsl", "readonly buffer ParticlesBefore { uint before[]; }",
          "buffer ParticlesBefore { uint before[]; }");
    plant(folder, "lifecycle/move.comp", "    store(j);\n", "    store(j);\n    before[j * 11u] ^= 1u;\n");
    lifecycle::Settings s = shower();
    s.switches.layout = lifecycle::Layout::bytes_44;
    CHECK_THROWS_WITH(run_lifecycle(s, 6, CheckMode::resync, (folder.path() / "lifecycle").string()),
                      Catch::Contains("move changed the particles in the copy that it reads"));
}

TEST_CASE("lifecycle: what diverges and leaves a state that its twins cannot go on from keeps its verdict") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "lifecycle");
    plant(folder, "lifecycle/post_destroy.comp", "uint died = counters[u_Emitter].may_die - s;",
          "uint died = present() - s;");
    const CheckReport report = run_lifecycle(shower(), 60, CheckMode::resync, (folder.path() / "lifecycle").string());
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::divergent);
    CHECK(report.partial());
    CHECK_FALSE(report.interrupted());
    CHECK(report.ended_by.find("the twin of ") != std::string::npos);
    CHECK(report_text(report, {}).find("DIVERGENT (partial: stopped after ") != std::string::npos);
}

} // namespace lockstep::test::kernels_test
