#include <algorithm>
#include <bit>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/dust/scene.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "reference/half.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::switches_test {

/// The switches of the source (its open points), by their names, values and presets; and those that change few bits.
namespace dust = lockstep::dust;

namespace {

struct Row {
    std::string_view name;
    std::vector<std::string_view> values;
    std::string_view paper, corrected;
};

const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"random", {"sin", "sin_portable", "integer"}, "sin", "sin_portable"},
        {"populate", {"plane", "uv", "line"}, "line", "line"},
        {"modulo", {"fmod", "div_frac"}, "fmod", "fmod"},
        {"tail_guard", {"first"}, "first", "first"},
        {"velocity_start", {"zero"}, "zero", "zero"},
        {"kernel_order", {"update_first", "tools_first"}, "update_first", "tools_first"},
        {"suction", {"lerp", "step", "cone_step", "force_in_update", "force_kernel"}, "force_kernel", "force_kernel"},
        {"forecast", {"own", "moved"}, "own", "own"},
        {"death_range", {"unset", "set"}, "unset", "set"},
        {"blow_falloff", {"distance", "square"}, "distance", "distance"},
        {"impulse_dt", {"frame", "constant", "constant_but_wind"}, "constant", "constant_but_wind"},
        {"emit_speed", {"direct", "force"}, "force", "force"},
        {"emit_axis", {"z"}, "z", "z"},
        {"world", {"none", "floor_clamp", "floor_radius", "floor_bounce", "box"}, "box", "box"},
        {"world_order", {"first", "last"}, "last", "last"},
        {"one_hit", {"off", "on"}, "on", "on"},
        {"sphere_touch", {"less", "less_equal"}, "less", "less_equal"},
        {"box_kind", {"aabb", "obb"}, "obb", "obb"},
        {"box_detect", {"rounded", "boxed"}, "boxed", "boxed"},
        {"sphere_data", {"vec4", "matrix"}, "matrix", "matrix"},
        {"plane_cast", {"ratio", "normalized"}, "ratio", "ratio"},
        {"gravity_dir", {"down", "vector"}, "vector", "vector"},
        {"drag", {"free", "by_mass"}, "free", "free"},
        {"last_collider", {"zeros", "none"}, "zeros", "none"},
        {"colour_format", {"rgb32f", "rgb16f"}, "rgb32f", "rgb32f"},
        {"draw_bounds", {"box", "off"}, "box", "off"},
        {"mesh", {"cube", "quad"}, "quad", "quad"}};
    return all;
}

/// Those of ours that mend something.
const std::map<std::string_view, std::string_view>& remedies() {
    static const std::map<std::string_view, std::string_view> all{
        {"walls", "all"},         {"clamp_velocity", "zero"}, {"sweep", "on"},       {"inside", "push_out"},
        {"safe_direction", "on"}, {"root", "clamp"},          {"side_exit", "keep"}, {"emit_seed", "index_time"},
        {"emit_disc", "even"},    {"drag_step", "implicit"}};
    return all;
}

std::string_view value_of(const dust::Switches& switches, std::string_view name) {
    for (const SwitchValue& one : switch_values(switches))
        if (one.name == name)
            return one.values.at(one.value);
    FAIL("there is no switch " << name);
    return {};
}

dust::Switches set(const std::string& text) {
    return dust::load_scene("data/scenes/dust/obb.json", {.set = {text}}).switches;
}

/// A room for movements that are long beside what they may hit.
dust::Settings fast_room(std::size_t count) {
    dust::Settings s;
    s.count = count;
    s.switches.random = dust::Random::integer;
    s.gravity = {20.0F, -900.0F, 350.0F};
    s.spawn = {{-20.0F, 0.0F, -20.0F}, {20.0F, 20.0F, 20.0F}};
    s.world = s.spawn;
    s.elasticity = 0.9F;
    s.colliders = {{.position = {0.0F, 4.0F, 0.0F}, .radius = 1.5F},
                   {.position = {5.0F, 3.0F, 4.0F}, .radius = 0.8F},
                   {.sphere = false, .position = {-8.0F, 5.0F, -3.0F}, .scale = {6, 0.5F, 4}, .rotate = {10, 20, 30}},
                   {.sphere = false, .position = {8.0F, 7.0F, -8.0F}, .scale = {0.4F, 5, 5}}};
    return s;
}

/// No bit differs, plain and exact, judged and run free.
void expect_agreement(const dust::Settings& settings, int frames) {
    for (const dust::Settings& s : {settings, in_exact(settings)})
        for (const CheckMode mode : {CheckMode::resync, CheckMode::free}) {
            const CheckReport report = run_dust(s, frames, mode);
            INFO(report_text(report, {}));
            CHECK(report.verdict == Verdict::agree);
        }
}

} // namespace

TEST_CASE("dust switches: each has the source's values, and its two presets") {
    CHECK(rows().size() + 1 == 28); // with radius_of_scale, a number
    const dust::Switches paper = dust::preset("paper"), corrected = dust::preset("corrected");
    CHECK(paper.radius_of_scale == 1.0F);
    CHECK(corrected.radius_of_scale == 0.5F);
    for (const Row& row : rows()) {
        INFO(row.name);
        CHECK(value_of(paper, row.name) == row.paper);
        CHECK(value_of(corrected, row.name) == row.corrected);
        for (const std::string_view value : row.values)
            if (row.name != "box_detect" || value == "boxed") // rounded goes with aabb
                CHECK(value_of(set(std::string(row.name) + "=" + std::string(value)), row.name) == value);
        for (const SwitchValue& one : switch_values(corrected))
            CHECK((one.name != row.name || one.values == row.values));
    }
}

TEST_CASE("dust switches: remedies are off in every preset and stage, and known by the source's names") {
    for (const auto& [name, on] : remedies()) {
        INFO(name);
        for (const char* preset : {"paper", "corrected", "exact"})
            CHECK(value_of(dust::preset(preset), name) != on);
        CHECK(value_of(dust::stage("s13", {}), name) != on);
        CHECK(value_of(set(std::string(name) + "=" + std::string(on)), name) == on);
    }
    for (const SwitchValue& one : switch_values(dust::Switches())) {
        const bool of_source =
            std::any_of(rows().begin(), rows().end(), [&](const Row& row) { return row.name == one.name; });
        INFO(one.name);
        CHECK((of_source || remedies().contains(one.name) || one.name == "unit"));
    }
}

TEST_CASE("dust switch forecast: moved asks again who dies, where gravity has moved the grain") {
    dust::Settings s;
    s.count = 1;
    s.switches.random = dust::Random::integer;
    s.gravity = {0.0F, -3600.0F, 0.0F};
    s.air_resistance = 0.0F;
    s.world = {glm::vec3(-100.0F), glm::vec3(100.0F)};
    s.tools = {{.kind = dust::Tool::Kind::vacuum,
                .from = 0,
                .to = 1,
                .force = 1e-3F,
                .range = 20.0F,
                .angle = 45.0F,
                .death_range = 2.1F}};
    for (const dust::Forecast forecast : {dust::Forecast::own, dust::Forecast::moved})
        for (const auto order : {dust::KernelOrder::tools_first, dust::KernelOrder::update_first}) {
            s.switches.forecast = forecast;
            s.switches.kernel_order = order;
            const bool tools_first = order == dust::KernelOrder::tools_first;
            Grains grains(host_of(s));
            grains.place(0, {0.0F, 1.0F, 2.0F}, {});
            grains.run("vacuum_up", 0);
            CHECK(grains.alive() == 1);                // its own forecast is 2.2 from the mouth
            grains.run("update", tools_first ? 0 : 1); // moves it to (0, 0, 2)
            CHECK(grains.alive() == (forecast == dust::Forecast::moved ? 0 : 1));
            CHECK(grains.count() == static_cast<std::uint32_t>(grains.alive()));
            Grains beside(host_of(s)); // the cone does not have it
            beside.place(0, {0.0F, 1.0F, 0.5F}, {});
            beside.run("vacuum_up", 0);
            beside.run("update", tools_first ? 0 : 1);
            CHECK(beside.alive() == 1);
        }
}

TEST_CASE("dust switch forecast: the kernels agree with their twins in either order") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s;
    s.count = 3000;
    s.spawn = {{-12.0F, 0.0F, -12.0F}, {12.0F, 12.0F, 12.0F}};
    s.world = s.spawn;
    s.switches.forecast = dust::Forecast::moved;
    s.switches.kernel_order = GENERATE(dust::KernelOrder::tools_first, dust::KernelOrder::update_first);
    s.controller = {{0, {0.0F, 5.0F, -4.0F}, {0.0F, 0.1F, 1.0F}}, {40, {4.0F, 6.0F, 0.0F}, {1.0F, 0.0F, 1.0F}}};
    s.tools = {
        {.kind = dust::Tool::Kind::vacuum, .from = 1, .to = 30, .force = 30.0F, .range = 14.0F, .death_range = 1.5F},
        {.kind = dust::Tool::Kind::emit, .from = 30, .to = 45, .force = 20.0F, .angle = 30.0F}};
    s.colliders = {{.position = {2.0F, 4.0F, 2.0F}, .radius = 2.0F}};
    expect_agreement(s, 50);
}

TEST_CASE("dust switch sphere_data: four floats a sphere have the bits of its matrices") {
    dust::Settings matrices = fast_room(2000);
    matrices.gravity = {0.0F, -9.8F, 0.0F};
    dust::Settings four = matrices;
    four.switches.sphere_data = dust::SphereData::vec4;
    const System one = dust::system(host_of(matrices)), other = dust::system(host_of(four));
    ReferenceRun by_matrices(one, named_profile("strict")), by_four(other, named_profile("strict"));
    for (int frame = 0; frame < 60; ++frame) {
        by_matrices.step(frame);
        by_four.step(frame);
    }
    CHECK(by_matrices.hash() == by_four.hash());
    if (!gl())
        return skip(gl().missing());
    expect_agreement(four, 40);
}

TEST_CASE("dust switch colour_format: half floats are the nearest to the colours, and the kernels agree") {
    dust::Settings s = fast_room(2000);
    s.colour_a = {0.1F, 0.9F, 1e-5F};
    s.colour_b = {0.7F, 0.2F, 70000.0F};
    dust::Settings halves = s;
    halves.switches.colour_format = dust::ColourFormat::rgb16f;
    Grains one(host_of(s)), other(host_of(halves));
    one.run("populate");
    other.run("populate");
    std::size_t rounded = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        for (int c = 0; c < 3; ++c) {
            CHECK(other.colour(i)[c] == half_round(one.colour(i)[c]));
            CHECK((std::bit_cast<std::uint32_t>(other.colour(i)[c]) & 0x1fffU) == 0);
            rounded += other.colour(i)[c] == one.colour(i)[c] ? 0 : 1;
        }
    CHECK(rounded > s.count);
    if (!gl())
        return skip(gl().missing());
    expect_agreement(halves, 3);
}

TEST_CASE("dust remedy sweep: what passes through a collider within a frame hits it, and the kernels agree") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s = fast_room(3000);
    s.switches.sweep = dust::OffOn::on;
    s.switches.one_hit = GENERATE(dust::OffOn::on, dust::OffOn::off);
    SECTION("turned boxes") {}
    SECTION("axis-aligned boxes, rounded") {
        s.switches.box_kind = dust::BoxKind::aabb;
        s.switches.box_detect = dust::BoxDetect::rounded;
    }
    SECTION("axis-aligned boxes, boxed, by unit rays") {
        s.switches.box_kind = dust::BoxKind::aabb;
        s.switches.plane_cast = dust::PlaneCast::normalized;
        s.switches.root = dust::Root::clamp;
        s.switches.inside = dust::Inside::push_out;
    }
    expect_agreement(s, 40);
}

TEST_CASE("dust remedy sweep: a box's thin plate stops what flies through it, and what flies past it goes on") {
    for (const auto kind : {dust::BoxKind::obb, dust::BoxKind::aabb})
        for (const auto sweep : {dust::OffOn::off, dust::OffOn::on}) {
            dust::Settings s;
            s.count = 4;
            s.switches.random = dust::Random::integer;
            s.switches.box_kind = kind;
            s.switches.sweep = sweep;
            s.gravity = glm::vec3(0.0F);
            s.air_resistance = 0.0F;
            s.world = {glm::vec3(-100.0F), glm::vec3(100.0F)};
            s.colliders = {{.sphere = false, .scale = {10.0F, 0.2F, 10.0F}}};
            Grains grains(host_of(s));
            grains.place(0, {1.0F, 2.0F, 1.0F}, {0.0F, -240.0F, 0.0F}); // through it
            grains.place(1, {9.0F, 2.0F, 1.0F}, {0.0F, -240.0F, 0.0F}); // beside it
            grains.place(2, {1.0F, 5.0F, 1.0F}, {0.0F, -240.0F, 0.0F}); // not so far
            grains.place(3, {1.0F, 2.0F, 1.0F}, {0.0F, 240.0F, 0.0F});  // away from it
            grains.run("update");
            CHECK((grains.velocity(0).y > 0.0F) == (sweep == dust::OffOn::on));
            CHECK((grains.position(0).y > 0.0F) == (sweep == dust::OffOn::on));
            for (std::size_t i = 1; i < 4; ++i)
                CHECK(std::abs(grains.velocity(i).y) == 240.0F);
        }
}

TEST_CASE("dust switches: a run's text names the preset whose arithmetic it is, and what differs from it") {
    dust::Settings settings;
    const auto text = [&] { return dust::system(host_of(settings)).settings; };
    settings.switches = dust::preset("corrected");
    CHECK(text() == "corrected");
    settings.switches = dust::preset("exact");
    settings.arithmetic = ArithmeticSwitch::exact;
    CHECK(text() == "exact");
    settings.switches.world = dust::World::none;
    CHECK(text() == "exact, but world=none");
    settings.arithmetic = ArithmeticSwitch::plain;
    CHECK(text() == "corrected, but random=integer world=none");
}

} // namespace lockstep::test::switches_test
