#include "crosscheck/judge/item_place.hpp"

#include <catch2/catch.hpp>

#include "reference/model/error.hpp"

namespace lockstep::test::item_place_test {

namespace {

Resource of(int dimensions) {
    Resource light;
    light.item = "texel";
    light.dimensions = dimensions;
    return light;
}

} // namespace

TEST_CASE("item place: an image's item is named by column, row and layer, a buffer's by its number") {
    CHECK(item_name(of(1), {12, 1, 1}, 7) == "texel 7");
    CHECK(item_name(of(2), {4, 3, 1}, 7) == "texel (3, 1)");
    CHECK(item_name(of(3), {4, 3, 2}, 23) == "texel (3, 2, 1)");
    CHECK(item_name(of(2), {}, 7) == "texel 7");
    CHECK(item_argument(of(3), {4, 3, 2}, 13) == "1,0,1");
}

TEST_CASE("item place: what a name says is read back, and the number of an image's item too") {
    for (const int dimensions : {1, 2, 3}) {
        const Extent extent{4, dimensions > 1 ? 3U : 1U, dimensions > 2 ? 2U : 1U};
        for (std::size_t i = 0; i < extent.count(); ++i) {
            CHECK(item_named(item_argument(of(dimensions), extent, i), of(dimensions), extent, "it") == i);
            CHECK(item_named(std::to_string(i), of(dimensions), extent, "it") == i);
        }
    }
}

TEST_CASE("item place: what is no item is refused with those there are") {
    const auto refusal = [](const char* text, int dimensions, const Extent& extent) -> std::string {
        try {
            return std::to_string(item_named(text, of(dimensions), extent, "glow"));
        } catch (const Error& error) {
            return error.what();
        }
    };
    for (const char* wrong :
         {"", "-1", "12", "x", "1,", ",1", "4,0", "0,3", "1,2,0", "1 ,2", "1,2 ", "18446744073709551616"})
        CHECK(refusal(wrong, 2, {4, 3, 1}) == "there is no texel '" + std::string(wrong) + "'; glow has 0,0 to 3,2");
    CHECK(refusal("1,0", 1, {4, 1, 1}) == "there is no texel '1,0'; glow has 0 to 3");
    CHECK(refusal("0,0,2", 3, {4, 3, 2}) == "there is no texel '0,0,2'; glow has 0,0,0 to 3,2,1");
    CHECK(refusal("0", 1, {0, 1, 1}) == "there is no texel '0'; glow has none");
}

} // namespace lockstep::test::item_place_test
