#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::ribbons_test {

namespace lifecycle = lockstep::lifecycle;
namespace counter = lifecycle::counter;

namespace {

/// An emitter that goes to and fro, once a second, and rests a while.
lifecycle::Settings ribbon(std::size_t capacity, double rate) {
    lifecycle::Settings s = in_exact({});
    s.camera.eye = {0.0F, 1.0F, 8.0F};
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = capacity;
    e.rate = rate;
    e.lifetime = {0.4F, 0.4F};
    e.path = {{0, {-2, 0, 0}}, {15, {2, 1, 0}}, {25, {2, 1, 0}}, {40, {-2, 0, 1}}, {60, {0, 3, 0}}};
    e.speed = 0.02F;
    e.draw = lifecycle::Emitter::Draw::ribbon;
    return s;
}

void expect_agreement(const lifecycle::Settings& s, int frames) {
    const CheckReport report = run_lifecycle(s, frames, CheckMode::free);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

std::uint32_t alive(const SystemState& state) {
    return state.view().word({lifecycle::counter_buffer, counter::alive}, 0);
}

} // namespace

TEST_CASE("ribbons: three ways to lay a texture along them, both sums and joints, agree with their twins") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = ribbon(600, 2000.0);
    const int variant = GENERATE(0, 1, 2, 3);
    s.emitters[0].uv = static_cast<lifecycle::Emitter::Uv>(variant % 3);
    if (variant % 2 == 1) {
        s.switches.ribbon_joint = lifecycle::RibbonJoint::average;
        s.switches.stretched_divisor = lifecycle::StretchedDivisor::count;
        s.switches.layout = lifecycle::Layout::bytes_112;
    }
    if (variant == 3) {
        s.emitters[0].uv = lifecycle::Emitter::Uv::distance;
        s.switches.distance_sum = lifecycle::DistanceSum::float_blocks;
        s.switches.uv_anchor = lifecycle::UvAnchor::oldest;
    }
    expect_agreement(s, 30);
}

TEST_CASE("ribbons: 0, 1, 2, 1 and 0 points") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = ribbon(4, 0.0);
    s.emitters[0].bursts = {{2, 1}, {4, 1}};
    s.emitters[0].lifetime = {0.1F, 0.1F};
    expect_agreement(s, 15);
    const System system = lifecycle::system(host_of(s));
    ReferenceRun run = reference_of(system);
    std::vector<std::uint32_t> counts;
    for (int frame = 0; frame < 15; ++frame) {
        run.step(frame);
        if (counts.empty() || counts.back() != alive(run.state()))
            counts.push_back(alive(run.state()));
        const std::uint32_t segments = run.state().view().word(field_named(system.schema, "draw_ribbon"), 0);
        CHECK(segments == (alive(run.state()) == 2 ? 1U : 0U));
    }
    CHECK(counts == std::vector<std::uint32_t>{0, 1, 2, 1, 0});
}

TEST_CASE("ribbons: the distances are sums of the way, and u stays where it was when the oldest dies") {
    lifecycle::Settings s = ribbon(300, 600.0);
    s.switches.layout = lifecycle::Layout::bytes_112;
    const auto jump = [&](lifecycle::UvAnchor anchor) {
        s.switches.uv_anchor = anchor;
        const System system = lifecycle::system(host_of(s));
        const FieldId position = field_named(system.schema, "position"), u = field_named(system.schema, "u"),
                      start = field_named(system.schema, "distance_from_start");
        ReferenceRun run = reference_of(system);
        double most = 0.0;
        std::vector<float> last;
        for (int frame = 0; frame < 60; ++frame) {
            run.step(frame);
            const SystemView state = run.state().view();
            double sum = 0.0;
            for (std::size_t i = 0; i < alive(run.state()); ++i) {
                if (i > 0)
                    sum += double(glm::length(state.vec3(position, i) - state.vec3(position, i - 1)));
                if (std::abs(double{state.real(start, i)} - sum) > 1e-3)
                    FAIL_CHECK("frame " << frame << ", point " << i << ": " << state.real(start, i) << ", not " << sum);
            }
            const std::uint32_t died = state.word({lifecycle::counter_buffer, counter::died}, 0);
            for (std::size_t i = 0; i + died < last.size() && i < alive(run.state()); ++i)
                most = std::max(most, std::abs(double{state.vec2(u, i).x} - double{last[i + died]}));
            last.clear();
            for (std::size_t i = 0; i < alive(run.state()); ++i)
                last.push_back(state.vec2(u, i).x);
        }
        return most;
    };
    CHECK(jump(lifecycle::UvAnchor::fixed) < 0.05); // the points go on a little
    CHECK(jump(lifecycle::UvAnchor::oldest) > 0.2);
}

TEST_CASE("ribbons: fixed sums never run backwards, over points that lie close or coincide") {
    lifecycle::Settings s = ribbon(1500, 60000.0);
    s.emitters[0].path = {{0, {0, 0, 0}}, {1, {7, 3, 1}}, {2, {7.3F, 3, 1}}, {3, {7.3F, 3, 1}}};
    s.emitters[0].direction_jitter = 2.0F;
    s.emitters[0].speed = 1.0F;
    s.switches.spawn_spread = lifecycle::SpawnSpread::path;
    s.switches.uv_anchor = lifecycle::UvAnchor::oldest;
    s.switches.layout = lifecycle::Layout::bytes_112;
    const auto backwards = [&](lifecycle::DistanceSum sum) {
        s.switches.distance_sum = sum;
        const System system = lifecycle::system(host_of(s));
        const FieldId start = field_named(system.schema, "distance_from_start");
        ReferenceRun run = reference_of(system);
        int count = 0;
        for (int frame = 0; frame < 4; ++frame) {
            run.step(frame);
            for (std::size_t i = 1; i < alive(run.state()); ++i)
                count += run.state().view().real(start, i) < run.state().view().real(start, i - 1) ? 1 : 0;
        }
        return count;
    };
    CHECK(backwards(lifecycle::DistanceSum::fixed) == 0);
}

TEST_CASE("ribbons: the specification's five points, stretched and by distance") {
    // (0,0,0) (3,4,0) (3,4,0) (3,4,12) (9,4,20), one a frame; they stay where they are born.
    lifecycle::Settings s = in_exact({});
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 8;
    e.bursts = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};
    e.path = {{0, {0, 0, 0}}, {1, {3, 4, 0}}, {2, {3, 4, 0}}, {3, {3, 4, 12}}, {4, {9, 4, 20}}};
    e.speed = 0.0F;
    e.draw = lifecycle::Emitter::Draw::ribbon;
    const auto u_of = [&](lifecycle::Emitter::Uv uv, lifecycle::StretchedDivisor divisor, float scale) {
        e.uv = uv;
        e.uv_scale = scale;
        s.switches.stretched_divisor = divisor;
        const System system = lifecycle::system(host_of(s));
        ReferenceRun run = reference_of(system);
        for (int frame = 0; frame < 5; ++frame)
            run.step(frame);
        std::vector<float> all;
        for (std::size_t i = 0; i < 5; ++i)
            all.push_back(run.state().view().vec2(field_named(system.schema, "u"), i).x);
        return all;
    };
    using lifecycle::Emitter;
    using lifecycle::StretchedDivisor;
    using Floats = std::vector<float>;
    CHECK(u_of(Emitter::Uv::distance, StretchedDivisor::last_index, 1.0F) == Floats{0, 5, 5, 17, 27});
    CHECK(u_of(Emitter::Uv::distance, StretchedDivisor::last_index, 0.1F) == Floats{0, 0.5F, 0.5F, 1.7F, 2.7F});
    CHECK(u_of(Emitter::Uv::stretched, StretchedDivisor::last_index, 1.0F) == Floats{0, 0.25F, 0.5F, 0.75F, 1});
    CHECK(u_of(Emitter::Uv::stretched, StretchedDivisor::count, 1.0F) == Floats{0, 0.4F, 0.6F, 0.8F, 1});
}

} // namespace lockstep::test::ribbons_test
