#include <string>

#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/text_mutants.hpp"

namespace lockstep::test::mutants_test {

namespace lifecycle = lockstep::lifecycle;

namespace {

/// Small systems in which what a mutant changes has something to do.
lifecycle::Settings settings_of(const std::string& run) {
    using Kind = lifecycle::Force::Kind;
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 2500;
    e.rate = 1800.0;
    e.lifetime = {0.1F, 0.3F};
    e.shape = lifecycle::Emitter::Shape::box;
    e.min = {-1.0F, 0.2F, -1.0F};
    e.max = {1.0F, 0.5F, 1.5F};
    e.direction = {0.3F, 1.0F, 0.2F};
    e.direction_jitter = 0.5F;
    e.speed_jitter = 0.25F;
    e.acceleration = {0.5F, -9.8F, 0.25F};
    e.size = {0.1F, 0.03F};
    e.color = {glm::vec4(0.6F, 0.81F, 1.0F, 0.9F), glm::vec4(0.2F, 0.4F, 0.77F, 0.1F)};
    s.switches.time_code = lifecycle::TimeCode::half_seconds;
    if (run == "ticks")
        s.switches.time_code = lifecycle::TimeCode::ticks16;
    if (run == "towards")
        s.switches.half_rounding = lifecycle::HalfRounding::toward_zero;
    if (run == "full")
        e.capacity = 300;
    if (run == "crowd")
        e.rate = 60000.0, e.capacity = 20000, s.switches.may_die = lifecycle::MayDie::all;
    if (run == "kill")
        e.forces = {{.kind = Kind::attraction, .centre = {0.0F, 0.4F, 0.0F}, .kill_radius = 0.5F}};
    if (run.starts_with("lists")) {
        s.switches.management = lifecycle::Management::index_lists;
        s.switches.layout = lifecycle::Layout::bytes_112;
        s.switches.uv_anchor = lifecycle::UvAnchor::oldest;
    }
    if (run == "lists_before")
        s.switches.emit_when = lifecycle::EmitWhen::before_destroy;
    if (run == "lists_atomic")
        s.switches.compaction = lifecycle::Compaction::atomic;
    if (run == "lists_ribbon") {
        e.draw = lifecycle::Emitter::Draw::ribbon;
        e.capacity = 250;
    }
    if (run == "forces") {
        s.switches.layout = lifecycle::Layout::bytes_112;
        s.switches.fuse = lifecycle::Fuse::split;
        s.switches.emit_when = lifecycle::EmitWhen::before_destroy;
        e.forces = {{.kind = Kind::drag, .k = 0.8F},
                    {.kind = Kind::vortex,
                     .centre = {0.2F, 0.0F, 0.1F},
                     .axis = {0.2F, 1.0F, 0.1F},
                     .strength = 20.0F,
                     .radius = 2.0F,
                     .falloff = 2,
                     .pull = 5.0F},
                    {.kind = Kind::attraction, .centre = {0.0F, 2.0F, 0.0F}, .strength = 5.0F, .inverse_square = true},
                    {.kind = Kind::curl_noise, .strength = 9.0F, .frequency = 1.7F, .pan = {0, -0.5F, 0}}};
    }
    if (run == "ribbon") {
        e.shape = lifecycle::Emitter::Shape::point;
        e.rate = 2000.0;
        e.capacity = 900;
        e.speed = 0.05F;
        e.path = {{0, {-2, 0, 0}}, {15, {2, 1, 0}}, {25, {2, 1, 0}}, {40, {-2, 0, 1}}};
        e.draw = lifecycle::Emitter::Draw::ribbon;
        e.uv_scale = 0.75F;
        s.camera.eye = {0.0F, 1.0F, 8.0F};
        s.switches.layout = lifecycle::Layout::bytes_112;
    }
    return s;
}

constexpr int frames = 26;

Outcome run_of(const std::string& shaders, const std::string& run) {
    return outcome_of([&] { return run_lifecycle(settings_of(run), frames, CheckMode::resync, shaders); });
}

} // namespace

TEST_CASE("lifecycle mutants: each text stands in the shipped shader as often as the catalogue says") {
    check_texts("lifecycle");
}

TEST_CASE("lifecycle mutants: some are found and named, and the shipped shaders are not") {
    if (!gl())
        return skip(gl().missing());
    for (const char* const run : {"plain", "forces", "ribbon", "lists_ribbon"})
        CHECK(run_of("shaders/lifecycle", run).verdict == "AGREE");
    // Lists that are appended to by atomics have any order.
    const Outcome atomic = run_of("shaders/lifecycle", "lists_atomic");
    CHECK((atomic.verdict == "LEGAL" || atomic.verdict == "AGREE"));
    check_mutants("lifecycle",
                  {"acceleration_reversed", "born_backwards", "rank_inclusive", "ring_not_filled", "vortex_reversed",
                   "destroyed_below_zero", "side_flipped", "newborns_not_counted", "next_dead_given", "sorted_falling"},
                  run_of);
}

/// All of them, as a table: lockstep_tests_lifecycle "[mutants]"
TEST_CASE("lifecycle mutants: the whole catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    check_catalogue("lifecycle", run_of);
}

} // namespace lockstep::test::mutants_test
