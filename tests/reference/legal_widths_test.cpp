#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/legal_widths.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "crosscheck/report/verdict_text.hpp"

using namespace lockstep;

namespace {

const Schema schema{.system = "drops",
                    .resources = {{.name = "drops", .item = "drop", .title = "the drops", .fields = {{.name = "mass"}}},
                                  {.name = "speeds",
                                   .item = "pixel",
                                   .title = "the speeds",
                                   .fields = {{.name = "speed", .components = 2, .unit = "m/s"}},
                                   .dimensions = 2,
                                   .format = "rg32f"}}};

ItemVerdict legal_item(std::size_t index, std::size_t component, const Interval& set) {
    return {.index = index, .kind = DifferenceClass::rounding, .widest = LegalFloats{component, set}};
}

} // namespace

TEST_CASE("legal widths: half of the items, and the widest with its place") {
    LegalWidths widths;
    CHECK_FALSE(widths.widest());
    for (int i = 0; i < 9; ++i)
        widths.add({3, 1, static_cast<std::size_t>(i)}, {0, Interval(0.0, std::exp2(-i))});
    CHECK(widths.half() >= std::exp2(-4));
    CHECK(widths.half() <= std::exp2(-4) * 1.125);
    REQUIRE(widths.widest());
    CHECK(widths.widest()->place.index == 0);
    CHECK(widths.widest()->floats.width() == 1.0);
    LegalWidths one;
    one.add({0, 0, 0}, {0, Interval(1.0, 1.3)});
    CHECK(one.half() == one.widest()->floats.width());
}

TEST_CASE("legal widths: of points there is nothing, of anything no bound, joined the widest of both") {
    LegalWidths points, open;
    points.add({0, 0, 1}, {0, Interval(2.0F)});
    points.add({0, 0, 2}, {0, Interval(NAN)});
    CHECK(points.half() == 0.0);
    CHECK(points.widest()->floats.width() == 0.0);
    open.add({1, 0, 7}, {0, Interval::anything()});
    open.add({1, 0, 8}, {0, Interval(-HUGE_VAL, HUGE_VAL)});
    open.add({1, 0, 9}, {0, Interval(0.0, 0.5)});
    CHECK(open.half() == HUGE_VAL);
    points.join(open);
    CHECK(points.half() == Approx(0.5));
    CHECK(points.widest()->place.index == 7);
    LegalWidths none;
    none.join(points);
    CHECK(none.widest()->place.index == 7);
}

TEST_CASE("legal widths: a report has them of what differs and is legal, with unit, place and set") {
    const std::vector<Extent> extents{{.width = 4}, {.width = 4, .height = 2}};
    VerdictSummary summary(schema);
    CHECK(verdict_text(summary, schema, extents).find("leeway") == std::string::npos);
    summary.add(2, 1, std::vector{legal_item(5, 1, {0.25, 0.5}), legal_item(6, 0, {0.0, 0x1p-20})});
    const std::string text = verdict_text(summary, schema, extents);
    INFO(text);
    CHECK(text.find("leeway    the speeds: 9.54e-07 m/s for half of the pixels that differ, 0.25 m/s at most: speed.y "
                    "0.25 to 0.5, frame 2 pixel (1, 1)\n") != std::string::npos);
    CHECK(text.find("leeway    the drops") == std::string::npos);
    const nlohmann::json json = verdict_json(summary, schema, extents);
    CHECK(json["drop_leeway"].is_null());
    CHECK(json["pixel_leeway"]["widest"] == 0.25);
    CHECK(json["pixel_leeway"]["field"] == "speed");
    summary.add(3, 0, std::vector{legal_item(0, 0, Interval::anything())});
    CHECK(verdict_text(summary, schema, extents)
              .find("the drops: anything for half of the drops that differ, anything at most: mass anything") !=
          std::string::npos);
    CHECK(verdict_json(summary, schema, extents)["drop_leeway"]["widest"] == "anything");
}
