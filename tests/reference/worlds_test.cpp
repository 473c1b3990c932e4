#include <catch2/catch.hpp>

#include <bit>
#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "reference/readings/constant_divisor.hpp"
#include "reference/readings/worlds.hpp"

#include "reference/arithmetic.hpp"
#include "reference/collision/legal_outcomes.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::worlds_test {

namespace {

constexpr Site x{"x"}, y{"y"}, length_of{"length"}, below{"below"}, above{"above"}, cast{"cast"}, nearest{"nearest"};

using Reading = Worlds<Strict>;
struct State {
    Reading::Real a, b;
    auto fields() const { return std::tie(a, b); }
};

struct Ended {
    bool open = false;
    Interval a, b;
    std::vector<std::string> ties;
    Undefined undefined = Undefined::none;
};

template <class Twin> std::vector<Ended> run(Reading& reading, const Twin& twin) {
    std::vector<Ended> all;
    reading.run(twin, [&](const State* state, std::span<const Fork> forks, Undefined undefined) {
        Ended one;
        one.open = state == nullptr;
        one.undefined = undefined;
        if (state != nullptr)
            one.a = state->a.legal(), one.b = state->b.legal();
        for (const Fork& fork : forks)
            for (const OpenDecision& decision : fork.decisions)
                if (decision.site != nullptr)
                    one.ties.emplace_back(decision.site->label);
        all.push_back(one);
    });
    return all;
}

/// A length that GLSL leaves open by a few ULP around 1.
Reading::Real open_one(Reading& r) { return r.length(length_of, r.read(x, glm::vec3(0.6F, 0.8F, 0.0F))); }

} // namespace

TEST_CASE(
    "worlds: where factors may be taken in another order, every order is legal, and a single product is one float") {
    KnownOperations known = KnownOperations::all();
    known.factors_reordered = true;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> mantissa(1.0F, 2.0F);
    int wider = 0;
    for (int i = 0; i < 20'000; ++i) {
        const float v = mantissa(random), s = -mantissa(random), t = mantissa(random);
        Reading r(Strict(), known);
        const auto ends = run(r, [&] {
            const Reading::Real once = r.read(x, v) * r.read(y, s);
            return State{-once * r.read(y, t), r.divide(x, once, r.read(y, t))};
        });
        REQUIRE(ends.size() == 1);
        CHECK(ends[0].a.contains(-(v * s) * t));
        CHECK(ends[0].a.contains(-v * (s * t)));
        CHECK(ends[0].a.contains(-(v * t) * s));
        CHECK(ends[0].b.contains((v * s) / t));
        CHECK(ends[0].b.contains(v * (s / t)));
        CHECK(ends[0].b.contains((v / t) * s));
        CHECK(ends[0].b.contains(v * (s * (1.0F / t))));
        CHECK(ends[0].a.high - ends[0].a.low <= 9.0 * interval::ulp(ends[0].a.high));
        wider += v * (s * t) != (v * s) * t ? 1 : 0;
    }
    CHECK(wider > 1'000);
    Reading r(Strict(), known);
    const auto single = run(r, [&] {
        const Reading::Real product = r.read(x, 1.1F) * r.read(y, 1.3F);
        return State{product + r.read(x, 0.7F), product};
    });
    CHECK(single[0].a.is_point());
    CHECK(single[0].b.is_point());
}

TEST_CASE("worlds: a value's product with itself is never below 0, and that of two with the same set may be") {
    KnownOperations reordered = KnownOperations::all();
    reordered.factors_reordered = true;
    for (const KnownOperations& known : {KnownOperations::all(), KnownOperations(), reordered}) {
        Reading r(Strict(), known);
        const auto about_0 = [&](At at) { return r.unspecified(at, 0.0F, -0.5F, 0.25F); };
        const auto ends = run(r, [&] {
            const Reading::Real one = about_0(x), other = about_0(y);
            return State{one * one, one * other};
        });
        REQUIRE(ends.size() == 1);
        CHECK(ends[0].a.low == 0.0);
        CHECK(ends[0].a.contains(0.25F));
        CHECK(ends[0].a.high < 0.2500001);
        CHECK(ends[0].b.contains(-0.125F));

        const auto products = run(r, [&] {
            const Reading::Real half = about_0(x) * Reading::Real(0.5F);
            return State{half * half, r.sqrt(y, half * half)};
        });
        REQUIRE(products.size() == 1);
        CHECK(products[0].a.low == 0.0);
        CHECK(products[0].a.contains(0.0625F));
        CHECK(products[0].undefined == Undefined::none);
        CHECK(products[0].b.contains(0.25F));
    }
}

TEST_CASE("worlds: an answer holds for every copy of what was asked, and is taken back for the other way") {
    Reading r(Strict(), {});
    const auto ends = run(r, [&] {
        const Reading::Real length = open_one(r), copy = length;
        const bool smaller = r.decide(below, length < 1.0F);
        return State{copy, r.real(smaller ? 1 : 0)};
    });
    REQUIRE(ends.size() == 2);
    CHECK(ends[0].a.high == std::nextafter(1.0F, 0.0F));
    CHECK(ends[0].b.low == 1.0);
    CHECK(ends[1].a.low == 1.0);
    CHECK(ends[1].a.high > 1.0);
    CHECK(ends[1].b.low == 0.0);
    CHECK(ends[1].ties == std::vector<std::string>{"below"});
}

TEST_CASE("worlds: any of several, and not, are asked as all are") {
    Reading r(Strict(), {});
    const auto count = [&](const auto& condition) {
        return run(r,
                   [&] {
                       const Reading::Real length = open_one(r);
                       const bool yes = r.decide(below, condition(length));
                       return State{length, r.real(yes ? 1 : 0)};
                   })
            .size();
    };
    CHECK(count([](auto l) { return l < 1.0F || l > 2.0F; }) == 2);
    CHECK(count([](auto l) { return l < 2.0F || l > 1.0F; }) == 1);
    CHECK(count([](auto l) { return !(l < 1.0F || l > 2.0F); }) == 2);
    CHECK(count([](auto l) { return !(l < 2.0F); }) == 1);
    CHECK(count([](auto l) { return l > 2.0F && l != 1.0F; }) == 1);
    CHECK(count([](auto l) { return l < 2.0F && l != 1.0F; }) == 2);
}

TEST_CASE("worlds: a cast forks over the integers in reach, and over nothing where the value is open") {
    Reading r(Strict(), {});
    const auto ends = run(r, [&] {
        const Reading::Real length = open_one(r);
        return State{length, r.real(r.to_int(cast, length * 3.0F))};
    });
    REQUIRE(ends.size() == 2);
    CHECK(ends[0].b.low == 2.0);
    CHECK(ends[1].b.low == 3.0);
    const auto open = run(r, [&] {
        const Reading::Real quotient = r.divide(y, 1.0F, open_one(r) - 1.0F);
        return State{quotient, r.real(r.to_int(cast, quotient))};
    });
    REQUIRE(open.size() == 1);
    CHECK(open[0].open);
    CHECK(open[0].undefined == Undefined::unbounded);
}

TEST_CASE("worlds: more ways than are followed are undecided, never legal") {
    Reading r(Strict(), {});
    const auto ends = run(r, [&] {
        Reading::Real sum = 0.0F;
        for (int i = 0; i < 12; ++i) {
            const Reading::Real length = open_one(r);
            if (r.decide(below, length < 1.0F))
                sum = sum + r.uniform(x, std::ldexp(1.0F, i));
        }
        return State{sum, 0.0F};
    });
    REQUIRE(ends.size() == Reading::most_runs + 1);
    CHECK(ends.back().open);
    CHECK(ends.back().undefined == Undefined::undecided);
}

TEST_CASE("worlds: a decision between the offers of a choice") {
    Reading r(Strict(), {});
    const auto ends = run(r, [&] {
        auto best = least<int>(r, nearest, 10.0F);
        for (int i = 0; i < 3; ++i) {
            const Reading::Real length = open_one(r);
            if (i == 1 && r.decide(above, length > 1.0F))
                continue;
            best.offer(below, length < 5.0F, length, i);
        }
        return State{r.real(best.take().value_or(-1)), 0.0F};
    });
    std::multiset<double> chosen;
    for (const Ended& end : ends)
        chosen.insert(end.a.low);
    // Without the second: the first or the last. With it, it is 1 at most: so it is the first, it, or the last.
    CHECK(chosen == std::multiset<double>{0.0, 0.0, 1.0, 2.0, 2.0});
}

TEST_CASE("worlds: 24 equally near neighbours are 24 outcomes, in a millisecond") {
    FrameParams params;
    params.width = params.height = 64;
    params.constants.collision_range = 0.5F;
    params.constants.texel_collide_range = 2;
    params.collision_proj_view[3][3] = 3.0F;
    CollisionImage cdt(64, 64);
    const ParticleState before{{0.1F, -0.2F, 0.0F}, {0.6F, 0.8F, 0.0F}, 0.75F, -0.25F};
    const BaseTexelIndex base = base_texel(before.position, params, {});
    // Directions of one length: the permutations and signs of (2, 3, 6) / 7.
    int stored = 0;
    for (int row = -2; row <= 2; ++row)
        for (int column = -2; column <= 2; ++column) {
            if (row == 0 && column == 0)
                continue;
            glm::vec3 away(stored & 1 ? -2.0F : 2.0F, stored & 2 ? -3.0F : 3.0F, stored & 4 ? -6.0F : 6.0F);
            for (int turn = 0; turn < stored / 8; ++turn)
                away = {away.y, away.z, away.x};
            cdt.at(base.x + column, base.y + row) = {before.position + away / 28.0F, 1.0F};
            ++stored;
        }
    REQUIRE(stored == 24);
    std::vector<LegalOutcome> outcomes;
    double fastest = 1.0;
    for (int repeat = 0; repeat < 20; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
        outcomes = legal_outcomes(before, cdt, params, named_profile("strict"), {}, nullptr);
        fastest = std::min(fastest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    CHECK(outcomes.size() == 24);
    for (const LegalOutcome& outcome : outcomes)
        CHECK(outcome.hit);
    INFO(fastest * 1e6 << " us");
    CHECK(fastest < 1e-3);
}

namespace {

/// Tables of 1/x and inversesqrt whose values are off by up to `most` ULP, up and down from one to the next.
RootTables uneven_tables(int most) {
    RootTables tables;
    std::mt19937 random(3);
    const auto off = [&](double rounded) {
        const auto ulp = static_cast<double>(std::nextafter(static_cast<float>(rounded), 2.0F)) - rounded;
        return static_cast<float>(rounded + ulp * (static_cast<int>(random() % (2U * most + 1U)) - most));
    };
    for (std::uint32_t i = 0; i < (1U << 23U); ++i)
        tables.reciprocal.push_back(off(1.0 / (1.0 + i * 0x1p-23)));
    for (std::uint32_t i = 0; i < (1U << 24U); ++i)
        tables.inverse_sqrt.push_back(off(1.0 / std::sqrt(double{std::bit_cast<float>(0x3f800000U + i)})));
    return tables;
}

} // namespace

TEST_CASE(
    "worlds: of a set, quotients and roots by a driver's tables are all that its floats have, in the middle too") {
    const RootTables tables = uneven_tables(1);
    const DriverRoots fp(tables);
    const auto missed = [&](bool by_tables) {
        Worlds<DriverRoots> reading(fp, KnownOperations::all());
        if (by_tables)
            reading.take_roots_by_tables();
        std::size_t count = 0;
        for (float low = 1.01F; low < 3.9F; low *= 1.01F) {
            float high = low;
            for (int k = 0; k < 20; ++k)
                high = std::nextafter(high, 4.0F);
            Interval root, quotient;
            reading.run(
                [&] {
                    const auto set = reading.unspecified(x, 0.0F, low, high);
                    root = reading.sqrt(x, set).legal();
                    quotient = reading.divide(x, set, 2.7F).legal();
                    return set;
                },
                [](const auto*, std::span<const Fork>, Undefined) {});
            for (float v = low; v <= high; v = std::nextafter(v, 4.0F))
                count += (root.contains(fp.sqrt(v)) ? 0U : 1U) + (quotient.contains(fp.divide(v, 2.7F)) ? 0U : 1U);
        }
        return count;
    };
    CHECK(missed(false) > 0);
    CHECK(missed(true) == 0);
}

TEST_CASE("worlds: a division by a constant is one float, or, where the compiler may multiply, one of two") {
    for (const bool open : {false, true}) {
        Reading reading(Strict{}, KnownOperations::all());
        if (open)
            reading.open_constant_divisors();
        std::set<float> found;
        for (const Ended& one : run(reading, [&] {
                 const auto quotient = divided_by(reading, x, reading.read(x, 12357.0F), 82801.277F);
                 return State{quotient, quotient};
             }))
            found.insert(one.a.as_float());
        std::set<float> right{12357.0F / 82801.277F};
        if (open)
            right.insert(12357.0F * (1.0F / 82801.277F));
        CHECK(found == right);
    }
}

} // namespace lockstep::test::worlds_test
