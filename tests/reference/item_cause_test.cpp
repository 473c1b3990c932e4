#include <catch2/catch.hpp>

#include <stdexcept>
#include <tuple>
#include <vector>

#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "reference/system/item_twin.hpp"

using namespace lockstep;

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
    ItemCauseFinder finder(named);
    CHECK_THROWS_WITH(finder.add(judged, judge_items(judged)), "falls upwards");
}
