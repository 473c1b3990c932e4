#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "reference/model/lifecycle/half.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::invariants_test {

/// What must hold whatever the twins say, of the reference alone, and a simulator without buffers beside it.
namespace lifecycle = lockstep::lifecycle;
namespace counter = lifecycle::counter;

namespace {

lifecycle::Settings shower(std::size_t capacity) {
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = capacity;
    e.rate = 700.0;
    e.bursts = {{5, 200}, {20, 50}};
    e.lifetime = {0.1F, 0.4F};
    s.switches.layout = lifecycle::Layout::bytes_112;
    return s;
}

std::uint32_t count_of(const SystemState& state, std::uint8_t which, std::size_t emitter = 0) {
    return state.view().word({lifecycle::counter_buffer, which}, emitter);
}

/// SpawnTime and SpawnOrderInFrame of the living: who they are.
std::vector<std::pair<float, std::uint32_t>> living(const SystemState& state) {
    std::vector<std::pair<float, std::uint32_t>> all;
    const FieldId time = field_named(state.schema(), "spawn_time"),
                  order = field_named(state.schema(), "spawn_order_in_frame");
    for (std::size_t i = 0; i < count_of(state, counter::alive); ++i)
        all.emplace_back(state.view().real(time, i), state.view().word(order, i));
    return all;
}

} // namespace

TEST_CASE("invariants: alive' = alive + emitted - died, in birth order, each once, within the capacity") {
    using lifecycle::EmitWhen;
    lifecycle::Settings s = shower(GENERATE(1, 255, 256, 257));
    s.switches.emit_when = GENERATE(EmitWhen::before_destroy, EmitWhen::after_simulation);
    s.switches.may_die = GENERATE(lifecycle::MayDie::exact, lifecycle::MayDie::all);
    const System system = lifecycle::system(host_of(s));
    ReferenceRun run = reference_of(system);
    std::uint32_t alive = 0, serial = 0;
    for (int frame = 0; frame < 40; ++frame) {
        run.step(frame);
        const SystemState& now = run.state();
        alive += count_of(now, counter::emitted) - count_of(now, counter::died);
        serial += count_of(now, counter::emitted);
        CHECK(count_of(now, counter::alive) == alive);
        CHECK(alive <= s.emitters[0].capacity);
        CHECK(count_of(now, counter::serial) == serial);
        const auto all = living(now);
        CHECK(std::is_sorted(all.begin(), all.end()));
        CHECK(std::set(all.begin(), all.end()).size() == all.size());
    }
    CHECK(serial > 0);
}

TEST_CASE("invariants: a simulator without buffers has the same births and deaths") {
    using lifecycle::EmitWhen;
    lifecycle::Settings s = shower(150);
    s.switches.layout = lifecycle::Layout::bytes_40;
    s.switches.emit_when = GENERATE(EmitWhen::before_destroy, EmitWhen::after_simulation);
    s.emitters[0].lifetime = {0.2F, 0.2F};
    const lifecycle::HostPtr host = host_of(s);
    const System system = lifecycle::system(host);
    ReferenceRun run = reference_of(system);
    std::vector<int> ages; // ticks left
    const auto emit = [&](int frame) {
        const std::uint32_t asked = host->emitters()[0].request(frame);
        for (std::uint32_t k = 0; k < asked && ages.size() < s.emitters[0].capacity; ++k)
            ages.push_back(12);
    };
    for (int frame = 0; frame < 80; ++frame) {
        if (s.switches.emit_when == EmitWhen::before_destroy)
            emit(frame);
        std::erase_if(ages, [](int left) { return left <= 0; });
        for (int& left : ages)
            --left;
        if (s.switches.emit_when == EmitWhen::after_simulation)
            emit(frame);
        run.step(frame);
        CHECK(count_of(run.state(), counter::alive) == ages.size());
    }
}

TEST_CASE("invariants: split and fused leave the same living particles, in every layout") {
    lifecycle::Settings s = shower(500);
    s.switches.layout = static_cast<lifecycle::Layout>(GENERATE(0, 1, 2, 3, 4, 5, 6));
    s.emitters[0].forces = {{.kind = lifecycle::Force::Kind::curl_noise, .strength = 2.0F}};
    const auto words_after = [&](lifecycle::Fuse fuse) {
        s.switches.fuse = fuse;
        const System system = lifecycle::system(host_of(s));
        ReferenceRun run = reference_of(system);
        for (int frame = 0; frame < 40; ++frame)
            run.step(frame);
        std::vector<std::uint32_t> words;
        for (std::size_t i = 0; i < count_of(run.state(), counter::alive); ++i)
            for (const std::uint32_t word : item_words(run.state()[lifecycle::particle_buffer], i))
                words.push_back(word);
        return words;
    };
    const auto split = words_after(lifecycle::Fuse::split);
    CHECK(split.size() > 1000);
    CHECK(split == words_after(lifecycle::Fuse::fused));
}

TEST_CASE("invariants: the nominal window keeps the dead, the exact one none") {
    lifecycle::Settings s;
    s.emitters[0].capacity = 800;
    s.emitters[0].rate = 180.0;
    s.emitters[0].lifetime = {3.0F, 4.0F};
    s.switches.time_code = lifecycle::TimeCode::half_seconds;
    s.switches.half_rounding = lifecycle::HalfRounding::toward_zero;
    const auto zombies = [&](lifecycle::MayDie may_die) {
        s.switches.may_die = may_die;
        const System system = lifecycle::system(host_of(s));
        const FieldId lifetimes = field_named(system.schema, "lifetimes");
        ReferenceRun run = reference_of(system);
        std::uint32_t dead = 0, left = 0;
        for (int frame = 0; frame < 300; ++frame) {
            run.step(frame);
            left += dead - count_of(run.state(), counter::died);
            dead = 0;
            for (std::size_t i = 0; i < count_of(run.state(), counter::alive); ++i)
                dead += lifecycle::half_value(run.state().view().word(lifetimes, i) & 0xffffU) > 0.0F ? 0 : 1;
        }
        return left;
    };
    CHECK(zombies(lifecycle::MayDie::exact) == 0);
    CHECK(zombies(lifecycle::MayDie::nominal) > 0);
}

TEST_CASE("invariants: what does not fit is dropped and counted, or takes the place of the oldest") {
    lifecycle::Settings s = shower(100);
    s.emitters[0].lifetime = {10.0F, 10.0F};
    const auto after = [&](lifecycle::Overflow overflow) {
        s.switches.overflow = overflow;
        const System system = lifecycle::system(host_of(s));
        ReferenceRun run = reference_of(system);
        for (int frame = 0; frame < 30; ++frame)
            run.step(frame);
        return run.state();
    };
    const SystemState full = after(lifecycle::Overflow::drop_new);
    CHECK(count_of(full, counter::alive) == 100);
    CHECK(count_of(full, counter::dropped_total) + count_of(full, counter::serial) == 30 * 35 / 3 + 250);
    CHECK(living(full).front().first == 0.0F);
    const SystemState turning = after(lifecycle::Overflow::replace_oldest);
    CHECK(count_of(turning, counter::dropped_total) == 0);
    CHECK(count_of(turning, counter::serial) == 30 * 35 / 3 + 250);
    CHECK(living(turning).front().first > 0.3F);
    CHECK(count_of(turning, counter::alive) <= 100 + 12);
}

} // namespace lockstep::test::invariants_test
