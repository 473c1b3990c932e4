#include <catch2/catch.hpp>

#include <array>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/rounding_only.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::test::item_cause_test {

namespace {

constexpr Site height_before{"height before"};
constexpr Site lost{"lost"};
constexpr Site height{"height"};

const Schema& drops() {
    static const Schema schema{"drops", {{"drops", "drop", "the drops", {{"height", Scalar::float32, 1, "m"}}}}};
    return schema;
}

template <class R> struct Drop {
    typename R::Real height{};
    auto fields() { return std::tie(height); }
    auto fields() const { return std::tie(height); }
};

/// A drop falls by 0.5. What it computes of a height of its own making ends in an exception that no twin promises.
struct Falls {
    template <class R> Drop<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const auto before = r.read(height_before, in.before.real({0, 0}, item));
        const auto fall = r.note(lost, r.uniform(lost, 0.5F));
        if constexpr (requires { static_cast<float>(fall); })
            if (static_cast<float>(fall) < 0.0F)
                throw std::runtime_error("falls upwards");
        return {r.note(height, before - fall)};
    }
};

} // namespace

TEST_CASE("item cause: what a twin throws when a mistake is tried leaves the search as an error") {
    const auto pass = item_pass({.name = "fall"}, Falls{});
    SystemState before(drops(), {{64}});
    for (std::size_t i = 0; i < 64; ++i)
        before.set({0, 0}, i, 4.0F + static_cast<float>(i));
    SystemState reference = before, gpu = before;
    const Profile profile = named_profile("strict");
    const KnownOperations known = measured_operations(profile);
    const SystemView from = before.view();
    run_pass(*pass, {from, 0}, profile, reference[0]);
    for (std::size_t i = 0; i < 64; ++i)
        gpu.set({0, 0}, i, 3.25F + static_cast<float>(i));
    const View reference_view = std::as_const(reference)[0], gpu_view = std::as_const(gpu)[0];
    const JudgedPass judged{*pass, profile, known, 0, from, reference_view, gpu_view};
    const std::vector<NamedMistake> named;
    ItemCauseFinder finder(named, "fall");
    CHECK_THROWS_WITH(finder.add(judged, judge_items(judged)), "falls upwards");
}

namespace {

constexpr Site side_before{"side before"}, drift{"drift"}, side{"side"};

const Schema& leaves() {
    static const Schema schema{
        "leaves",
        {{"leaves", "leaf", "the leaves", {{"height", Scalar::float32, 1, "m"}, {"side", Scalar::float32, 1, "m"}}}}};
    return schema;
}

template <class R> struct Leaf {
    typename R::Real height{}, side{};
    auto fields() { return std::tie(height, side); }
    auto fields() const { return std::tie(height, side); }
};

struct Sinks {
    template <class R> Leaf<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const auto high = r.read(height_before, in.before.real({0, 0}, item));
        const auto wide = r.read(side_before, in.before.real({0, 1}, item));
        return {r.note(height, high - r.uniform(lost, 0.5F)), r.note(side, wide + r.uniform(drift, 0.25F))};
    }
};

} // namespace

TEST_CASE("item cause: two mistakes at once in any pass are found as a pair of names") {
    const auto pass = item_pass({.name = "sink"}, Sinks{});
    SystemState before(leaves(), {{200}});
    for (std::size_t i = 0; i < 200; ++i) {
        before.set({0, 0}, i, 4.0F + static_cast<float>(i));
        before.set({0, 1}, i, 0.125F * static_cast<float>(i));
    }
    SystemState reference = before, gpu = before;
    const Profile profile = named_profile("strict");
    const KnownOperations known = measured_operations(profile);
    const SystemView from = before.view();
    run_pass(*pass, {from, 0}, profile, reference[0]);
    for (std::size_t i = 0; i < 200; ++i) {
        gpu.set({0, 0}, i, 3.0F + static_cast<float>(i));
        gpu.set({0, 1}, i, 0.125F * static_cast<float>(i) - 0.25F);
    }
    const View reference_view = std::as_const(reference)[0], gpu_view = std::as_const(gpu)[0];
    const JudgedPass judged{*pass, profile, known, 0, from, reference_view, gpu_view};
    const std::vector<NamedMistake> named{
        {"falls_not", "the height stays", "sink", mistake_at(lost, Change::zero)},
        {"falls_twice", "the height falls twice as far", "sink", mistake_at(lost, Change::doubled)},
        {"drifts_back", "the wind comes from the other side", "sink", mistake_at(drift, Change::negated)}};
    ItemCauseFinder finder(named, "sink");
    finder.add(judged, judge_items(judged));
    const CauseFindings found = finder.findings();
    REQUIRE(found.explains_all());
    CHECK(found.best.front().name() == "falls_twice + drifts_back");
    CHECK(found.best.front().explained == 200);

    ItemCauseFinder seen_elsewhere(named, "sink");
    seen_elsewhere.add(judged, judge_items(judged), [](std::span<const NamedMistake* const>) { return 7; });
    CHECK_FALSE(seen_elsewhere.findings().explains_all());
}

TEST_CASE("item cause: nothing finite is near what is infinite") {
    constexpr float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
    const auto near = [](std::array<float, 2> a, std::array<float, 2> b, std::array<float, 2> before) {
        return differ_by_rounding(a, b, before);
    };
    CHECK_FALSE(near({infinite, 0.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}));
    CHECK_FALSE(near({1.0F, 2.0F}, {1.0F, 3.0F}, {infinite, 0.0F}));
    CHECK_FALSE(near({infinite, 0.0F}, {-infinite, 0.0F}, {0.0F, 0.0F}));
    CHECK_FALSE(near({none, 0.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}));
    CHECK(near({infinite, 1.0F}, {infinite, 1.0000001F}, {0.0F, 0.0F}));
    CHECK(near({none, 1.0F}, {none, 1.0F}, {0.0F, 0.0F}));
}

} // namespace lockstep::test::item_cause_test
