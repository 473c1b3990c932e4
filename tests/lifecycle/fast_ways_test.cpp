#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "reference/lifecycle/move_fast.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::fast_ways_test {

/// Passes that make many items at once have the bits of their twins, item by item.
namespace lifecycle = lockstep::lifecycle;
namespace counter = lifecycle::counter;

namespace {

constexpr std::uint32_t alive = 700, may_die = 90, survivors = 41;

/// Particles of any bits, in the midst of a frame; the second of two emitters.
SystemState any_state(const System& system, std::mt19937& random) {
    SystemState state = system.start;
    const auto any_words = [&](std::uint8_t resource, std::uint32_t below) {
        const WritableView view = state[resource];
        for (std::uint8_t f = 0; f < view.fields().size(); ++f)
            for (std::size_t item = 0; item < view.count(); ++item)
                for (int c = 0; c < view.fields()[f].components; ++c) {
                    const auto word = static_cast<std::uint32_t>(random());
                    // Each fourth a tiny half or none.
                    state.set({resource, f}, item,
                              below != 0 ? word % below : word & (word % 4 == 0 ? 0x83ff83ffU : ~0U), c);
                }
    };
    any_words(lifecycle::particle_buffer, 0);
    any_words(lifecycle::survivor_buffer, may_die);
    for (std::uint8_t r = lifecycle::dead_buffer; r < state.schema().resources.size(); ++r)
        any_words(r, 800);
    for (std::size_t emitter = 0; emitter < 2; ++emitter)
        for (const auto& [which, value] : {std::pair{counter::alive, alive},
                                           {counter::may_die, may_die},
                                           {counter::survivors, survivors},
                                           {counter::append, survivors},
                                           {counter::emitted, 60U}})
            state.set({lifecycle::counter_buffer, which}, emitter, value);
    return state;
}

/// Bit by bit; any NaN is as any other.
bool same(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, const Resource& about) {
    std::size_t w = 0;
    return std::ranges::all_of(components(about), [&](const Component& c) {
        const bool is_float = about.fields[c.field].scalar == Scalar::float32;
        const auto is_nan = [](std::uint32_t bits) { return (bits & 0x7fffffffU) > 0x7f800000U; };
        const std::uint32_t one = a.at(w), other = b.at(w++);
        return one == other || (is_float && is_nan(one) && is_nan(other));
    });
}

void none_may_die(SystemState& state) {
    for (std::size_t emitter = 0; emitter < 2; ++emitter)
        for (const std::uint8_t which : {counter::may_die, counter::survivors, counter::append})
            state.set({lifecycle::counter_buffer, which}, emitter, 0);
}

/// Of the passes that make items of these buffers; at least as many as `passes`.
void expect_bits_of_twin(const lifecycle::Settings& settings, const std::vector<std::uint8_t>& buffers = {0},
                         std::size_t least_passes = 4, bool some_die = true) {
    const System system = lifecycle::system(host_of(settings));
    std::mt19937 random(11);
    SystemState before = any_state(system, random);
    if (!some_die)
        none_may_die(before);
    const Profile profile = named_profile("strict");
    const bool is_fast =
        lifecycle::has_move_fast(lifecycle::Host(settings), lifecycle::Host(settings).emitters().front());
    std::size_t passes = 0;
    for (const auto& pass : system.passes) {
        const std::uint8_t made_by = pass->resource();
        if (std::ranges::find(buffers, made_by) == buffers.end())
            continue;
        ++passes;
        const SystemView view = before.view();
        const PassInput in{view, 5};
        SystemState after = before;
        run_pass(*pass, in, profile, after[made_by]);
        std::size_t off = 0;
        for (std::size_t item = 0; item < view[made_by].count(); ++item) {
            const auto made = item_words(std::as_const(after)[made_by], item);
            off += same(made, pass->mistaken(in, item, profile, {}), view[made_by].about()) ? 0 : 1;
        }
        INFO(pass->name());
        CHECK(off == 0);
        if (pass->in_place(in)) {
            SystemState in_place = before;
            run_pass(*pass, {in_place.view(), 5}, profile, in_place[made_by]);
            CHECK(state_hash(in_place) == state_hash(after));
        }
        if (pass->name() == "move" || pass->name() == "move_particles")
            CHECK(pass->in_place(in) == (!some_die && is_fast));
    }
    CHECK(passes >= least_passes);
}

lifecycle::Settings two_emitters() {
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 800;
    e.rate = 3000.0;
    e.lifetime = {0.1F, 0.4F};
    e.direction_jitter = 0.5F;
    s.emitters.push_back(e);
    return s;
}

} // namespace

TEST_CASE("fast ways: moving, simulating and emitting many at once has the twin's bits, whatever the particles hold") {
    using namespace lifecycle;
    Settings s = two_emitters();
    s.switches.layout = GENERATE(Layout::bytes_64, Layout::bytes_40);
    s.switches.integration = GENERATE(Integration::semi_implicit, Integration::explicit_euler, Integration::ballistic);
    const int more = static_cast<int>(s.switches.integration);
    s.switches.fuse = GENERATE(Fuse::split, Fuse::fused);
    s.arithmetic = GENERATE(ArithmeticSwitch::plain, ArithmeticSwitch::exact);
    s.switches.half_rounding =
        (more + static_cast<int>(s.arithmetic)) % 2 == 0 ? HalfRounding::nearest_even : HalfRounding::toward_zero;
    s.switches.time_code = more == 1 ? TimeCode::half_seconds : TimeCode::ticks16;
    s.switches.emit_when = more == 2 ? EmitWhen::before_destroy : EmitWhen::after_simulation;
    s.switches.compaction = more == 2 ? Compaction::atomic : Compaction::scan;
    REQUIRE(has_move_fast(Host(s), Host(s).emitters().front()));
    expect_bits_of_twin(s);
    expect_bits_of_twin(s, {particle_buffer}, 4, false); // then they move in place
}

TEST_CASE("fast ways: where a switch or a force leaves none, the twin runs") {
    using namespace lifecycle;
    Settings s = two_emitters();
    switch (GENERATE(0, 1, 2, 3, 4)) {
    case 0:
        s.switches.layout = Layout::bytes_112;
        break;
    case 1:
        s.switches.half_rounding = HalfRounding::dithered;
        break;
    case 2:
        s.switches.position_code = PositionCode::box16;
        break;
    case 3:
        s.emitters.front().forces = {{.kind = Force::Kind::drag, .k = 0.5F}};
        break;
    default:
        s.switches.curl_use = CurlUse::velocity;
    }
    REQUIRE_FALSE(has_move_fast(Host(s), Host(s).emitters().front()));
    expect_bits_of_twin(s);
}

TEST_CASE("fast ways: lists of the living and of the dead have the twin's bits") {
    using namespace lifecycle;
    Settings s = two_emitters();
    s.switches.management = Management::index_lists;
    s.switches.compaction = Compaction::atomic; // by sums the living are found from those
    s.switches.layout = GENERATE(Layout::bytes_112, Layout::bytes_40);
    s.switches.emit_when = GENERATE(EmitWhen::before_destroy, EmitWhen::after_simulation);
    expect_bits_of_twin(s, {particle_buffer, survivor_buffer, dead_buffer}, 10);
}

TEST_CASE("fast ways: a ribbon's points are sorted and added up with the twin's bits") {
    using namespace lifecycle;
    Settings s = two_emitters();
    for (Emitter& e : s.emitters)
        e.draw = Emitter::Draw::ribbon;
    s.switches.distance_sum = GENERATE(DistanceSum::fixed, DistanceSum::float_blocks);
    s.switches.management = GENERATE(Management::move_alives, Management::index_lists);
    s.switches.uv_anchor = UvAnchor::oldest;
    s.switches.layout = s.switches.management == Management::index_lists ? Layout::bytes_112 : Layout::bytes_40;
    s.arithmetic = GENERATE(ArithmeticSwitch::plain, ArithmeticSwitch::exact);
    const bool sorts = s.switches.management == Management::index_lists;
    expect_bits_of_twin(s, sorts ? std::vector<std::uint8_t>{length_buffer, key_buffer} : std::vector{length_buffer},
                        sorts ? 100 : 4);
}

} // namespace lockstep::test::fast_ways_test
