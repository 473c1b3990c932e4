#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "reference/lifecycle/sort_twin.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::index_lists_test {

namespace lifecycle = lockstep::lifecycle;

namespace {

/// Particles that stay in their slots, more of them than fit, in two emitters.
lifecycle::Settings listed(lifecycle::Compaction compaction, lifecycle::EmitWhen when) {
    lifecycle::Settings s;
    s.switches.management = lifecycle::Management::index_lists;
    s.switches.compaction = compaction;
    s.switches.emit_when = when;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 700;
    e.rate = 3600.0;
    e.bursts = {{7, 500}};
    e.lifetime = {0.1F, 0.4F};
    e.shape = lifecycle::Emitter::Shape::box;
    e.max = {1.0F, 0.5F, 1.0F};
    e.direction_jitter = 0.5F;
    s.emitters.push_back(e);
    s.emitters.back().capacity = 70;
    return s;
}

lifecycle::Settings sorted_ribbon() {
    lifecycle::Settings s = listed(lifecycle::Compaction::scan, lifecycle::EmitWhen::after_simulation);
    s.switches.layout = lifecycle::Layout::bytes_112;
    s.switches.uv_anchor = lifecycle::UvAnchor::oldest;
    s.emitters.back().draw = lifecycle::Emitter::Draw::ribbon;
    s.emitters.back().rate = 300.0;
    return s;
}

std::vector<std::uint32_t> words(const SystemView& state, FieldId field, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(state.word(field, first + i));
    return all;
}

} // namespace

TEST_CASE("index lists: every slot stands in one of the lists, once") {
    const auto host =
        host_of(listed(GENERATE(lifecycle::Compaction::scan, lifecycle::Compaction::atomic),
                       GENERATE(lifecycle::EmitWhen::before_destroy, lifecycle::EmitWhen::after_simulation)));
    const System system = lifecycle::system(host);
    ReferenceRun run = reference_of(system);
    std::uint32_t deaths = 0, dropped = 0;
    for (int frame = 0; frame < 40; ++frame) {
        run.step(frame);
        const SystemState end = run.state();
        const SystemView state = end.view();
        for (const lifecycle::HostEmitter& of : host->emitters()) {
            const auto counted = [&](std::uint8_t word) {
                return state.word({lifecycle::counter_buffer, word}, of.number);
            };
            const std::uint32_t alive = counted(lifecycle::counter::alive);
            std::vector<std::uint32_t> all = words(state, {lifecycle::survivor_buffer, 0},
                                                   2 * of.base + counted(lifecycle::counter::list) * of.slots, alive);
            for (const std::uint32_t slot : words(state, {lifecycle::dead_buffer, 0}, of.base, of.slots - alive))
                all.push_back(slot);
            std::sort(all.begin(), all.end());
            bool each_once = all.size() == of.slots;
            for (std::size_t slot = 0; slot < all.size(); ++slot)
                each_once = each_once && all[slot] == slot;
            INFO("frame " << frame << ", emitter " << of.number << ", " << alive << " alive");
            CHECK(each_once);
            deaths += counted(lifecycle::counter::died);
            dropped += counted(lifecycle::counter::dropped);
        }
    }
    CHECK(deaths > 1000);
    CHECK(dropped > 1000);
}

TEST_CASE("index lists: both sides agree, by prefix sums in every bit and by atomics but for the order") {
    if (!gl())
        return skip(gl().missing());
    const auto when = GENERATE(lifecycle::EmitWhen::before_destroy, lifecycle::EmitWhen::after_simulation);
    const CheckReport scan = run_lifecycle(in_exact(listed(lifecycle::Compaction::scan, when)), 26, CheckMode::free);
    INFO(report_text(scan, {}));
    CHECK(scan.verdict == Verdict::agree);
    const CheckReport atomic = run_lifecycle(listed(lifecycle::Compaction::atomic, when), 26);
    INFO(report_text(atomic, {}));
    CHECK((atomic.verdict == Verdict::agree || atomic.verdict == Verdict::legal));
}

TEST_CASE("index lists: a ribbon's points are sorted by birth, and agree on both sides") {
    const lifecycle::Settings settings = sorted_ribbon();
    const auto host = host_of(settings);
    const lifecycle::HostEmitter& of = host->emitters().back();
    const System system = lifecycle::system(host);
    ReferenceRun run = reference_of(system);
    bool other_order = false;
    for (int frame = 0; frame < 40; ++frame) {
        run.step(frame);
        const SystemState end = run.state();
        const SystemView state = end.view();
        const std::uint32_t alive = state.word({lifecycle::counter_buffer, lifecycle::counter::alive}, of.number);
        std::vector<lifecycle::Key> keys;
        for (std::size_t i = 0; i < of.keys; ++i)
            keys.push_back(lifecycle::key_at({state, frame}, of.first_key + i));
        CHECK(std::is_sorted(keys.begin(), keys.end()));
        CHECK(std::adjacent_find(keys.begin(), keys.begin() + alive) == keys.begin() + alive);
        other_order = other_order || !std::is_sorted(keys.begin(), keys.begin() + alive,
                                                     [](const auto& a, const auto& b) { return a[2] < b[2]; });
    }
    CHECK(other_order);
    if (!gl())
        return skip(gl().missing());
    const CheckReport report = run_lifecycle(in_exact(settings), 30, CheckMode::free);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE("index lists: both managements hold the same particles, but that lists drop the expired at once") {
    lifecycle::Settings settings = sorted_ribbon();
    settings.emitters.erase(settings.emitters.begin());
    settings.emitters.front().capacity = 300;
    settings.emitters.front().bursts.clear();
    const auto particles = [&](lifecycle::Management management) {
        settings.switches.management = management;
        const auto host = host_of(settings);
        const System system = lifecycle::system(host);
        ReferenceRun run = reference_of(system);
        for (int frame = 0; frame < 50; ++frame)
            run.step(frame);
        const SystemState end = run.state();
        const SystemView state = end.view();
        std::vector<std::vector<std::uint32_t>> all;
        for (std::uint32_t i = 0; i < state.word({lifecycle::counter_buffer, lifecycle::counter::alive}, 0); ++i) {
            const std::uint32_t slot = host->lists() ? state.word({lifecycle::key_buffer, 2}, i) : i;
            std::vector<std::uint32_t> words = item_words(state[lifecycle::particle_buffer], slot);
            constexpr std::size_t remaining = 15, from_previous = 23;
            words.resize(from_previous);
            if (std::bit_cast<float>(words[remaining]) > 0.0F)
                all.push_back(std::move(words));
        }
        return all;
    };
    const auto moved = particles(lifecycle::Management::move_alives);
    CHECK(moved.size() > 20);
    CHECK(particles(lifecycle::Management::index_lists) == moved);
}

} // namespace lockstep::test::index_lists_test
