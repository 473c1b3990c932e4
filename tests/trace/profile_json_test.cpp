#include <catch2/catch.hpp>

#include "crosscheck/scene/profile_json.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::profile_json_test {

using Catch::Contains;

namespace {

Profile read(const std::string& text) {
    const nlohmann::json document = parse_json(text, "profile");
    return read_profile(JsonValue(document, "profile"));
}

bool same(const Profile& a, const Profile& b) { return profile_json(a) == profile_json(b) && computes_alike(a, b); }

} // namespace

TEST_CASE("profile json: every known profile comes back as it was") {
    for (const char* name : {"strict", "llvmpipe", "nvidia"}) {
        const Profile profile = named_profile(name);
        CHECK(same(read(profile_json(profile).dump()), profile));
    }
    Profile other = named_profile("nvidia");
    other.name = "generic";
    other.errors = {1, 2, 3, 4, 5, INT64_MAX};
    other.raster = {11, SnapRounding::down, SnapRounding::half_up, ViewportRounding::fused, true, false, false, false};
    other.not_followed = {"points: snap"};
    other.errors.fragment_divide = 7;
    other.converts = {.triangles = true};
    other.point_window_accurate = false;
    other.point_sizes = {0.5F, 63.0F};
    const Profile back = read(profile_json(other).dump());
    CHECK(same(back, other));
    CHECK(back.errors.normalize == INT64_MAX);
    CHECK(back.raster == other.raster);
    CHECK(back.errors.fragment_divide == 7);
    CHECK(back.converts == other.converts);
    CHECK(back.point_window_accurate == false);
    CHECK(back.point_sizes == other.point_sizes);
    CHECK(back.corner_window_accurate == true);
}

TEST_CASE(
    "profile json: an older program's has one division, and nobody looked at the accuracy of window coordinates") {
    const Profile old = read(R"({"name": "nvidia", "raster": {"subpixel_bits": 8}, "ulp_errors": {"divide": 5}})");
    CHECK(old.errors.fragment_divide == 5);
    CHECK(old.errors.fragment_reciprocal == 1);
    CHECK_FALSE(old.point_window_accurate);
    CHECK_FALSE(old.corner_window_accurate);
}

TEST_CASE("profile json: what is left out is the named profile's") {
    CHECK(same(read(R"({"name": "llvmpipe"})"), named_profile("llvmpipe")));
    const Profile mine = read(R"json({"name": "mine", "dot": "x+(y+z)"})json");
    CHECK(mine.dot == DotOrder::right_to_left);
    CHECK(mine.flush_subnormals);
}

TEST_CASE("profile json: what cannot be is refused with what can") {
    const auto refusal = [](const std::string& text) { return test::error_of([&] { read(text); }); };
    CHECK_THAT(refusal("{}"), Contains("the key \"name\" is missing"));
    CHECK_THAT(refusal(R"({"name": "x", "dots": 1})"), Contains("unknown key \"dots\""));
    CHECK_THAT(refusal(R"({"name": "x", "dot": "z+y"})"), Contains("/dot: \"z+y\" is not one of (x+y)+z, x+(y+z)"));
    CHECK_THAT(refusal(R"({"name": "x", "raster": {"subpixel_bits": 40}})"),
               Contains("/raster/subpixel_bits: 40 is not an integer from 4 to 12"));
    CHECK_THAT(refusal(R"({"name": "x", "ulp_errors": {"divide": -1}})"), Contains("/ulp_errors/divide"));
    CHECK_THAT(refusal(R"({"name": "x", "ulp_errors": {"cbrt": 1}})"), Contains("unknown key \"cbrt\""));
    CHECK_THAT(refusal(R"({"name": "x", "not_followed": "all"})"), Contains("/not_followed"));
    CHECK_THAT(refusal(R"({"name": "x", "point_sizes": {"smallest": 2, "largest": 1}})"),
               Contains("/point_sizes: \"largest\" is below \"smallest\""));
    CHECK_THAT(refusal(R"({"name": "x", "raster": {"left_edge_in": true}})"), Contains("is not one of off, on"));
}

} // namespace lockstep::test::profile_json_test
