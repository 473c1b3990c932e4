#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/legal_widths.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "crosscheck/report/verdict_text.hpp"

namespace lockstep::test::legal_widths_test {

namespace {

const Schema schema{.system = "drops",
                    .resources = {{.name = "drops", .item = "drop", .title = "the drops", .fields = {{.name = "mass"}}},
                                  {.name = "speeds",
                                   .item = "pixel",
                                   .title = "the speeds",
                                   .fields = {{.name = "speed", .components = 2, .unit = "m/s"}},
                                   .dimensions = 2,
                                   .format = "rg32f"}}};

ItemVerdict legal_item(std::size_t index, std::vector<Interval> sets) {
    return {.index = index, .kind = DifferenceClass::rounding, .sets = std::move(sets)};
}

void add(LegalWidths& widths, int frame, std::size_t index, const Interval& set) {
    widths.add(frame, index, {&set, 1});
}

} // namespace

TEST_CASE("legal widths: half of the items, and the widest with its place") {
    LegalWidths widths(schema, 0);
    CHECK_FALSE(widths.widest());
    for (int i = 0; i < 9; ++i)
        add(widths, 3, static_cast<std::size_t>(i), Interval(0.0, std::exp2(-i)));
    CHECK(widths.half() >= std::exp2(-4));
    CHECK(widths.half() <= std::exp2(-4) * 1.125);
    REQUIRE(widths.widest());
    CHECK(widths.widest()->index == 0);
    CHECK(widths.widest()->floats.width() == 1.0);
    LegalWidths one(schema, 0);
    add(one, 0, 0, Interval(1.0, 1.3));
    CHECK(one.half() == one.widest()->floats.width());
}

TEST_CASE("legal widths: of points there is nothing, of anything no bound, joined the widest of both") {
    LegalWidths points(schema, 0), open(schema, 0);
    add(points, 0, 1, Interval(2.0F));
    add(points, 0, 2, Interval(NAN));
    CHECK(points.half() == 0.0);
    CHECK(points.widest()->floats.width() == 0.0);
    add(open, 1, 7, Interval::anything());
    add(open, 1, 8, Interval(-HUGE_VAL, HUGE_VAL));
    add(open, 1, 9, Interval(0.0, 0.5));
    CHECK(open.half() == HUGE_VAL);
    points.join(open);
    CHECK(points.half() == Approx(0.5));
    CHECK(points.widest()->index == 7);
    LegalWidths none(schema, 0);
    none.join(points);
    CHECK(none.widest()->index == 7);
}

TEST_CASE("legal widths: the sets of an item of another resource are refused") {
    const std::vector<Interval> of_speed(2, Interval(0.0, 1.0));
    CHECK_THROWS_AS(LegalWidths(schema, 0).add(0, 0, of_speed), std::logic_error);
    LegalWidths speeds(schema, 1);
    speeds.add(0, 0, of_speed);
    CHECK(speeds.widest()->floats.field == FieldId{1, 0});
}

TEST_CASE("legal widths: a report has them of what differs and is legal, with unit, place and set") {
    const std::vector<Extent> extents{{.width = 4}, {.width = 4, .height = 2}};
    VerdictSummary summary(schema);
    CHECK(verdict_text(summary, schema, extents).find("leeway") == std::string::npos);
    summary.add(2, 1, std::vector{legal_item(5, {{0.0, 0.125}, {0.25, 0.5}}), legal_item(6, {{0.0, 0x1p-20}, 1.0F})});
    const std::string text = verdict_text(summary, schema, extents);
    INFO(text);
    CHECK(text.find("leeway    the speeds: 9.54e-07 m/s for half of the pixels that differ, 0.25 m/s at most: speed.y "
                    "0.25 to 0.5, frame 2 pixel (1, 1)\n") != std::string::npos);
    CHECK(text.find("leeway    the drops") == std::string::npos);
    const nlohmann::json json = verdict_json(summary, schema, extents);
    CHECK(json["drop_leeway"].is_null());
    CHECK(json["pixel_leeway"]["widest"] == 0.25);
    CHECK(json["pixel_leeway"]["field"] == "speed");
    summary.add(3, 0, std::vector{legal_item(0, {Interval::anything()})});
    CHECK(verdict_text(summary, schema, extents)
              .find("the drops: anything for half of the drops that differ, anything at most: mass anything") !=
          std::string::npos);
    CHECK(verdict_json(summary, schema, extents)["drop_leeway"]["widest"] == "anything");
}

} // namespace lockstep::test::legal_widths_test
