#include <utility>

#include <catch2/catch.hpp>

#include "reference/model/system_state.hpp"

namespace lockstep::test::shared_fields_test {

namespace {

const Schema& schema() {
    static const Schema all =
        checked({"sparks",
                 {{.name = "sparks",
                   .item = "spark",
                   .title = "the sparks",
                   .fields = {{.name = "heat", .block = "heatBuffer"}, {.name = "hue", .block = "hueBuffer"}}}}});
    return all;
}
constexpr FieldId heat{0, 0}, hue{0, 1};
constexpr std::size_t count = 3;

SystemState sparks(float value) {
    SystemState state(schema(), {{count}});
    for (std::size_t i = 0; i < count; ++i) {
        state.set(heat, i, value);
        state.set(hue, i, value);
    }
    return state;
}

float first(const SystemState& state, FieldId field) { return state.view().real(field, 0); }

} // namespace

TEST_CASE("shared fields: one that is written stays with the other as it was") {
    const SystemState from = sparks(1.0F);
    SystemState to = sparks(2.0F);
    to.share(hue, from);
    CHECK(first(to, hue) == 1.0F);
    CHECK(first(to, heat) == 2.0F);
    to.set(hue, 0, 3.0F);
    CHECK(first(from, hue) == 1.0F);
    CHECK(first(to, hue) == 3.0F);
    CHECK(to.view().real(hue, 1) == 1.0F);
}

TEST_CASE("shared fields: who writes all of one anew does not change the other's, whose words serve again later") {
    SystemState from = sparks(1.0F), to = sparks(2.0F);
    to.share(hue, from);
    const std::byte* shared = std::as_const(to)[0].columns[hue.field];
    CHECK(shared == std::as_const(from)[0].columns[hue.field]);
    const WritableView fresh = to.all_but(std::vector<std::uint8_t>{heat.field}, 0);
    CHECK(fresh.columns[heat.field] == nullptr);
    CHECK(fresh.columns[hue.field] != shared);
    CHECK(first(from, hue) == 1.0F);

    // Copies of one state have their words from one place.
    SystemState copy = from;
    const std::byte* given_up = std::as_const(copy)[0].columns[hue.field];
    copy.share(hue, from);
    CHECK(copy.all_but({}, 0).columns[hue.field] == given_up);
}

TEST_CASE("shared fields: a state without any is its copy's own") {
    const SystemState from = sparks(1.0F);
    SystemState copy = from;
    copy.set(heat, 0, 5.0F);
    CHECK(first(from, heat) == 1.0F);
    SystemState assigned = sparks(4.0F);
    assigned = copy;
    assigned.set(heat, 1, 6.0F);
    CHECK(first(assigned, heat) == 5.0F);
    CHECK(copy.view().real(heat, 1) == 1.0F);
    SystemState larger(schema(), {{count + 5}});
    larger = copy;
    CHECK(first(larger, heat) == 5.0F);
    CHECK(larger.extent(0).count() == count);
}

} // namespace lockstep::test::shared_fields_test
