#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/arithmetic.hpp"
#include "reference/lifecycle/forces.hpp"
#include "reference/lifecycle/particle.hpp"
#include "reference/lifecycle/simulation.hpp"
#include "reference/readings/values.hpp"
#include "reference/system/noise.hpp"
#include "reference/system/turns.hpp"

namespace lockstep::test::worked_numbers_test {

/// The specification's own numbers, to the last digit.
using namespace lockstep::lifecycle;

namespace {

using Reading = Values<Strict>;
using Words = std::vector<std::uint32_t>;

Host host_with(lifecycle::Switches switches) {
    Settings settings;
    settings.switches = switches;
    return Host(settings);
}

template <class R> Words words_of(const ItemWords<R>& record) {
    Words all;
    record.for_each([&](const auto& x) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(x)>, std::uint32_t>)
            all.push_back(x);
        else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(x)>, LegalWord>)
            all.push_back(x.word);
        else
            all.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    });
    return all;
}

/// The particle of the worked example.
Particle<Reading> example(Reading& r, const Host& host) {
    Particle<Reading> p(r, host);
    p.set_position({1.5F, -2.25F, 0.1F});
    p.set_velocity({0.3F, 4.0F, -0.01F});
    p.set_acceleration({0.0F, -9.8F, 0.0F});
    p.set_birth(3.0F, 12.34F, 0);
    p.set_remaining(2.5F);
    p.set_sizes(0.05F, 0.2F);
    p.set_from_previous(0.07F);
    p.set_from_start(3.3F);
    p.set_color(false, {1.0F, 0.5F, 0.25F}, 1.0F);
    p.set_color(true, {0.2F, 0.0F, 0.0F}, 0.0F);
    return p;
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

Words bits3(const Vec3<float>& v) { return {bits(v.x), bits(v.y), bits(v.z)}; }

} // namespace

TEST_CASE("worked numbers: a particle packed to 40 bytes, in both roundings, and a step on") {
    Reading r{Strict{}};
    lifecycle::Switches s;
    s.time_code = TimeCode::half_seconds;
    s.half_rounding = HalfRounding::toward_zero;
    s.drag = Drag::explicit_force;
    const Host down = host_with(s);
    Particle<Reading> p = example(r, down);
    CHECK(words_of(p.record()) == Words{0x3e00c080, 0x2e6634cc, 0x4400a11e, 0x42004100, 0x0000c8e6, 0x00004a2b,
                                        0x2a663266, 0x2c7a4299, 0xff4080ff, 0x00000033});
    const HostPtr shared = std::make_shared<const Host>(down);
    simulate(r, frame_of(shared, shared->emitters().front(), 0), p);
    const Words after = words_of(p.record());
    // The specification prints a11f for velocity.z; without acceleration along z it stays a11e.
    CHECK(Words(after.begin(), after.begin() + 4) == Words{0x3e05c05f, 0x2e6334cc, 0x43aca11e, 0x420040f7});

    s.half_rounding = HalfRounding::nearest_even;
    const Host near = host_with(s);
    CHECK(words_of(example(r, near).record()) == Words{0x3e00c080, 0x2e6634cd, 0x4400a11f, 0x42004100, 0x0000c8e6,
                                                       0x00004a2c, 0x2a663266, 0x2c7b429a, 0xff4080ff, 0x00000033});
}

TEST_CASE("worked numbers: pcg3d") {
    CHECK(pcg3d({0, 0, 0}) == Bits3{0x9bafd7c6, 0xa8e88a6b, 0x3f15482c});
    CHECK(pcg3d({1, 2, 3}) == Bits3{0xfa9f79a6, 0x48f2f44c, 0x596f5ab1});
}

TEST_CASE("worked numbers: gradient noise and its curl") {
    Reading r{Strict{}};
    const Noise<Reading> noise(r, 1);
    const Vec3<float> x{0.5F, 0.25F, 0.75F}, y{-1.25F, 3.5F, 2.0625F};
    const auto psi = noise.all(x);
    CHECK(Words{bits(psi[0].value), bits(psi[1].value), bits(psi[2].value)} ==
          Words{0xbe064fc0, 0x3eb03d60, 0xbdc1bac0});
    CHECK(bits3(noise.analytic_curl(x)) == Words{0xbf8f2270, 0xbf746e68, 0xbdfa1b60});
    CHECK(bits3(noise.analytic_curl(y)) == Words{0x3f73e0cc, 0xbea9ac4c, 0x3e9cccc8});
}

TEST_CASE("worked numbers: a rate of 100 at 60 Hz is 1, 2, 2 particles a frame, and no fraction is lost") {
    const RateCounter rate(100.0, 1.0 / 60.0);
    std::uint64_t sum = 0;
    for (int frame = 0; frame < 6000; ++frame) {
        if (frame < 9)
            CHECK(rate.count(frame) == (frame % 3 == 0 ? 1U : 2U));
        sum += rate.count(frame);
    }
    CHECK((sum == 9999 || sum == 10000)); // the increment is rounded down
    const RateCounter most(16'777'215.0, 1.0);
    CHECK(most.count(1'000'000) == 16'777'215);
    CHECK(RateCounter(0.0, 1.0).count(7) == 0);
}

TEST_CASE("worked numbers: how many ticks the shortest lifetime lasts, as each layout stores it") {
    Settings s;
    const auto age = [&](Layout layout, TimeCode time, HalfRounding rounding, float life) {
        s.switches.layout = layout;
        s.switches.time_code = time;
        s.switches.half_rounding = rounding;
        return dying_age(s, life);
    };
    using enum HalfRounding;
    CHECK(age(Layout::bytes_112, TimeCode::half_seconds, nearest_even, 3.0F) == std::size_t{181});
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, nearest_even, 3.0F) == std::size_t{178});
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, toward_zero, 3.0F) == std::size_t{173});
    CHECK(age(Layout::bytes_40, TimeCode::ticks16, nearest_even, 3.0F) == std::size_t{180});
    // early_death and immortal
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, toward_zero, 10.0F) == std::size_t{520});
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, toward_zero, 30.0F) == std::size_t{1224});
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, nearest_even, 10.0F) == std::size_t{619});
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, nearest_even, 30.0F) == std::size_t{1899});
    CHECK_FALSE(age(Layout::bytes_40, TimeCode::half_seconds, nearest_even, 64.0625F));
    CHECK(age(Layout::bytes_40, TimeCode::half_seconds, nearest_even, 64.0F));
    s.switches.may_die = MayDie::nominal;
    s.emitters[0].lifetime = {3.0F, 3.0F};
    CHECK(Host(s).emitters().front().window == 180);
}

TEST_CASE("worked numbers: sine and cosine of turns lie within 1.7 * 2^-24") {
    Reading r{Strict{}};
    double worst = 0.0;
    for (int k = -200000; k <= 200000; ++k) {
        const float turns = static_cast<float>(k) * 1.0e-5F;
        const auto [sine, cosine] = sine_cosine(r, turns);
        const long double angle = 2.0L * std::acos(-1.0L) * static_cast<long double>(turns);
        worst = std::max({worst, static_cast<double>(std::abs(std::sin(angle) - static_cast<long double>(sine))),
                          static_cast<double>(std::abs(std::cos(angle) - static_cast<long double>(cosine)))});
    }
    CHECK(worst <= 1.7 * 0x1p-24);
}

} // namespace lockstep::test::worked_numbers_test
