#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/lights/left_open.hpp"
#include "crosscheck/report/run_to_run.hpp"
#include "reference/half.hpp"
#include "reference/lights/by_driver.hpp"
#include "reference/lights/contribution.hpp"
#include "tests/lights/lights_run.hpp"

namespace lockstep::test::left_open_test {

/// What GL leaves open: by drivers that are followed in it, and by others.
namespace lights = lockstep::lights;

namespace {

/// Between what is legal of an item of a pass, in a run's first frame.
std::vector<Interval> legal_of(const lights::Settings& settings, const std::string& pass, std::size_t item,
                               const Profile& profile) {
    const System system = lights::system(host_of(settings));
    ReferenceRun run(system, named_profile("strict"));
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        if (system.passes[p]->name() == pass) {
            const SystemView before = run.state().view();
            const auto outcomes =
                system.passes[p]->outcomes({before, 0}, item, profile, measured_operations(profile), nullptr);
            REQUIRE(!outcomes.empty());
            std::vector<Interval> all = outcomes.front().values;
            for (const ItemOutcome& one : outcomes)
                for (std::size_t i = 0; i < all.size(); ++i) {
                    all[i].any = all[i].any || one.values[i].any;
                    all[i].low = std::min(all[i].low, one.values[i].low);
                    all[i].high = std::max(all[i].high, one.values[i].high);
                }
            return all;
        }
        run.step_pass(p, 0);
    }
    FAIL("there is no pass " << pass);
    return {};
}

double width(const std::vector<Interval>& values) {
    double widest = 0.0;
    for (const Interval& one : values)
        widest = std::max(widest, one.any ? HUGE_VAL : one.high - one.low);
    return widest;
}

/// The item with the greatest number in a part of a field, after a frame.
std::size_t greatest(const lights::Settings& settings, FieldId field, int part) {
    const System system = lights::system(host_of(settings));
    ReferenceRun run(system, named_profile("strict"));
    run.step(0);
    const SystemView state = run.state().view();
    std::size_t found = 0;
    for (std::size_t i = 0; i < state[field.resource].count(); ++i)
        if (state.real(field, i, part) > state.real(field, found, part))
            found = i;
    return found;
}
std::size_t brightest_pixel(const lights::Settings& s) { return greatest(s, lights::field::pixel, 0); }
std::size_t fullest_voxel(const lights::Settings& s) { return greatest(s, lights::field::voxel_colour, 3); }

} // namespace

TEST_CASE("what a pass gives is legal of it, the bits that it copies too", "[lights]") {
    const System system = lights::system(host_of(room()));
    const Profile profile = named_profile("strict");
    ReferenceRun run(system, profile);
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        const ItemPass& pass = *system.passes[p];
        const SystemView before = run.state().view();
        const std::size_t count = before[pass.resource()].count(), apart = std::max<std::size_t>(count / 16, 1);
        std::vector<std::vector<ItemOutcome>> legal;
        for (std::size_t item = 0; item < count; item += apart)
            legal.push_back(pass.outcomes({before, 0}, item, profile, measured_operations(profile), nullptr));
        run.step_pass(p, 0);
        const SystemView after = run.state().view();
        for (std::size_t i = 0; i < legal.size(); ++i) {
            INFO(pass.name() << " " << i * apart);
            CHECK(std::any_of(legal[i].begin(), legal[i].end(),
                              [&](const ItemOutcome& one) { return one.contains(after[pass.resource()], i * apart); }));
        }
    }
}

TEST_CASE("lights left open: a filter that is followed leaves its forms, another what 8 bits give") {
    lights::Settings s = room();
    s.switches.interpolation = lights::Interpolation::trilinear_hw;
    s.switches.glow = lights::OffOn::off;
    s.arithmetic = ArithmeticSwitch::exact;
    const std::size_t pixel = brightest_pixel(s);
    const auto followed = legal_of(s, "deferred_light_pass", pixel, not_following({}));
    const auto open = legal_of(s, "deferred_light_pass", pixel,
                               not_following({lights::black_filter_row, lights::black_aligned_filter_row}));
    const auto aligned = legal_of(s, "deferred_light_pass", pixel, not_following({lights::black_filter_row}));
    CHECK(width(aligned) < 1e-6); // a bit where planes meet
    CHECK(width(followed) > 0.0);
    CHECK(1000.0 * width(followed) < width(open));
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(open[c].low <= followed[c].low);
        CHECK(followed[c].high <= open[c].high);
        CHECK(open[c].low <= aligned[c].low);
        CHECK(aligned[c].high <= open[c].high);
    }
    s.switches.outside = lights::Outside::clamp; // rests on other rows
    CHECK(width(legal_of(s, "deferred_light_pass", pixel,
                         not_following({lights::black_filter_row, lights::black_aligned_filter_row}))) ==
          width(legal_of(s, "deferred_light_pass", pixel, not_following({}))));
}

TEST_CASE("lights left open: what a filter in fixed point gives is legal of it, and of any with 8 fraction bits") {
    lights::Settings s = room();
    s.switches = lights::preset("paper");
    s.switches.accumulate = lights::Accumulate::gather;
    s.switches.pipeline = lights::Pipeline::deferred;
    s.switches.volume_format = GENERATE(lights::Format::rgba32f, lights::Format::rgba16f);
    s.switches.outside = GENERATE(lights::Outside::clamp, lights::Outside::black);
    s.arithmetic = ArithmeticSwitch::exact;
    const bool black = s.switches.outside == lights::Outside::black;
    const std::string float_row = black ? lights::black_filter_row : lights::filter_row,
                      aligned_row = black ? lights::black_aligned_filter_row : lights::aligned_filter_row;
    const System system = lights::system(host_of(s));
    const Profile aligned = not_following({float_row}), open = not_following({float_row, aligned_row});
    ReferenceRun run(system, aligned);
    std::size_t pass = 0;
    while (system.passes[pass]->name() != "deferred_light_pass")
        run.step_pass(pass++, 0);
    const SystemState state = run.state();
    run.step_pass(pass, 0);
    const View made = std::as_const(run.state())[lights::lit_image];
    const SystemView before = state.view();
    std::size_t wrong = 0, differs = 0;
    for (std::size_t item = 0; item < made.count(); item += 7) {
        const auto of_floats = system.passes[pass]->mistaken({before, 0}, item, not_following({}), {});
        differs += of_floats != item_words(made, item) ? 1U : 0U;
        for (const Profile& profile : {aligned, open}) {
            const auto legal =
                system.passes[pass]->outcomes({before, 0}, item, profile, measured_operations(profile), nullptr);
            wrong +=
                std::ranges::any_of(legal, [&](const ItemOutcome& one) { return one.contains(made, item); }) ? 0U : 1U;
        }
    }
    CHECK(wrong == 0);
    CHECK(differs > 20);
}

TEST_CASE(
    "lights left open: codes of sRGB are the nearest where the driver is followed, else either beside the curve") {
    lights::Settings s = room();
    s.switches.encoding = lights::Encoding::srgb_hw;
    s.switches.glow = lights::OffOn::off;
    s.ambient = {0.25F, 0.3F, 0.4F};
    const std::size_t pixel = brightest_pixel(s);
    CHECK(width(legal_of(s, "encode_by_gl_pass", pixel, not_following({}))) == 0.0);
    CHECK(width(legal_of(s, "encode_by_gl_pass", pixel, not_following({lights::srgb_row}))) == 1.0);
}

TEST_CASE("lights left open: blended sums are of one order where the driver is followed, else of any") {
    lights::Settings s = room(200);
    s.switches.accumulate = lights::Accumulate::blend;
    s.arithmetic = ArithmeticSwitch::exact;
    const std::size_t voxel = fullest_voxel(s);
    CHECK(width(legal_of(s, "light_volume_blend", voxel, not_following({}))) == 0.0);
    const auto open = legal_of(s, "light_volume_blend", voxel, not_following({lights::float_blend_row}));
    CHECK(width(open) > 0.0);
    CHECK(open[3].is_point()); // the count
    s.switches.accumulate = lights::Accumulate::blend_exact;
    CHECK(width(legal_of(s, "light_volume_blend", voxel, not_following({lights::float_blend_row}))) == 0.0);
}

TEST_CASE(
    "lights left open: halves that are blended are cut or rounded where followed, else either neighbour of each") {
    lights::Settings s = room(200);
    s.switches.accumulate = lights::Accumulate::blend;
    s.switches.volume_format = lights::Format::rgba16f;
    s.arithmetic = ArithmeticSwitch::exact;
    const std::size_t voxel = fullest_voxel(s);
    const double followed = width(legal_of(s, "light_volume_blend", voxel, not_following({})));
    const double open = width(legal_of(s, "light_volume_blend", voxel, not_following({lights::half_blend_row})));
    CHECK(followed > 0.0);
    CHECK(followed < open);
    CHECK(half_nearest(1.0F + 0x1p-11F) == 1.0F); // ties to even
    CHECK(half_nearest(1.0F + 0x3p-11F) == 1.0F + 0x1p-9F);
    CHECK(half_nearest(1.0F + 0x1.8p-11F) == 1.0F + 0x1p-10F);
    CHECK(half_nearest(0x1p-24F) == 0x1p-24F);
    CHECK(half_nearest(0x1.8p-24F) == 0x1p-23F); // of subnormal halves, too
    CHECK(half_nearest(65519.0F) == 65504.0F);
    CHECK(half_nearest(65520.0F) == HUGE_VALF);
    CHECK(half_nearest(-70000.0F) == -HUGE_VALF);
}

TEST_CASE("lights left open: a pass by driver that is prepared for its input is the same pass") {
    lights::Settings s = room();
    s.width = s.height = 16;
    const System system = lights::system(host_of(s));
    const auto glow = std::ranges::find(system.passes, "glow_pass", &ItemPass::name);
    REQUIRE(glow != system.passes.end());
    ReferenceRun run(system, named_profile("strict"));
    for (auto pass = system.passes.begin(); pass != glow; ++pass)
        run.step_pass(static_cast<std::size_t>(pass - system.passes.begin()), 0);
    const SystemView before = run.state().view();
    const PassInput in{before, 0};
    for (const Profile& profile : {not_following({}), not_following({lights::float_blend_row})}) {
        const std::unique_ptr<ItemPass> prepared = (*glow)->prepared(in, profile);
        REQUIRE(prepared != nullptr);
        CHECK(prepared->name() == "glow_pass");
        for (std::size_t pixel = 0; pixel < 256; ++pixel) {
            CHECK(prepared->mistaken(in, pixel, profile, {}) == (*glow)->mistaken(in, pixel, profile, {}));
            CHECK(prepared->outcomes(in, pixel, profile, measured_operations(profile), nullptr).size() ==
                  (*glow)->outcomes(in, pixel, profile, measured_operations(profile), nullptr).size());
        }
    }
}

TEST_CASE("lights left open: a report says on what a value rests, and which one promises bits") {
    const auto lines = [](const lights::Switches& on, const std::vector<std::string>& rows) {
        return fmt::format("{}", fmt::join(lights::left_open(on, not_following(rows)), "\n"));
    };
    using Catch::Contains;
    const lights::Switches paper = lights::preset("paper"), exact = lights::preset("exact");
    CHECK(lines(exact, {}).empty());
    CHECK(lines(exact, {lights::filter_row, lights::srgb_row}).empty());
    CHECK_THAT(lines(exact, {lights::float_blend_row}), Contains("glow=off promises bits"));
    CHECK_THAT(lines(paper, {}), Contains("accumulate=gather and fixed64 promise bits") && !Contains("encoding"));
    CHECK_THAT(lines(paper, {lights::srgb_row}), Contains("encoding=srgb_table promises bits") &&
                                                     Contains("(probe: image: sRGB store)") &&
                                                     !Contains("interpolation"));
    CHECK(!Catch::Contains("interpolation").match(lines(paper, {lights::filter_row})));
    CHECK_THAT(lines(paper, {lights::filter_row, lights::aligned_filter_row}),
               Contains("interpolation=trilinear promises bits"));
}

TEST_CASE("lights left open: what differs from run to run is told as such, and is legal") {
    if (!gl())
        return skip(gl().missing());
    const auto seen_of = [](lights::Accumulate accumulate, Verdict& verdict) {
        lights::Settings s = room(512);
        s.switches.accumulate = accumulate;
        s.width = s.height = 8;
        const lights::HostPtr host = host_of(s);
        const System system = lights::system(host);
        GlSystemSide side(gl(), system, lights::passes(host), "shaders/lights", s.arithmetic);
        std::vector<TwoRuns> seen;
        CheckWatch watch;
        watch_two_runs(watch, system, seen);
        CheckOptions options;
        options.frames = 3;
        options.causes = false;
        verdict = check(system, side, options, watch).verdict;
        return seen;
    };
    Verdict verdict = Verdict::agree;
    const std::vector<TwoRuns> cas = seen_of(lights::Accumulate::float_cas, verdict);
    CHECK((verdict == Verdict::agree || verdict == Verdict::legal));
    REQUIRE(cas.size() == 2); // the frames that are run twice
    for (std::size_t frame = 0; frame < 2; ++frame) {
        CHECK(cas[frame].pass == "light_volume_scatter");
        CHECK(cas[frame].frame == static_cast<int>(frame));
        CHECK(cas[frame].items == 8 * room().grid.count());
        CHECK(cas[frame].differing < cas[frame].items);
    }
    CHECK(seen_of(lights::Accumulate::fixed64, verdict).empty());
    CHECK(verdict == Verdict::agree);
}

TEST_CASE("lights left open: the line of a report on two runs") {
    const std::vector<TwoRuns> seen{{"a", 0, "word", 1234, 4096}, {"b", 0, "word", 0, 8}, {"a", 1, "word", 5, 4096}};
    const std::vector<std::string> notes = run_to_run_notes(seen);
    REQUIRE(notes.size() == 2);
    CHECK(notes[0] == "run to run, a: of two runs from one state differ, as GL allows of sums in no fixed order: "
                      "frame 0 1,234 of 4,096 words, frame 1 5 of 4,096");
    CHECK(notes[1] == "run to run, b: of two runs from one state differ, as GL allows of sums in no fixed order: frame "
                      "0 0 of 8 words");
}

} // namespace lockstep::test::left_open_test
