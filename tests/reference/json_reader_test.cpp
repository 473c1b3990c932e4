#include <catch2/catch.hpp>

#include <limits>
#include <string>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/error.hpp"

namespace lockstep::test::json_reader_test {

namespace {

std::string nested(std::size_t depth, char open, char close) {
    return std::string(depth, open) + std::string(depth, close);
}

} // namespace

TEST_CASE("json reader: depth has a limit, told with its place") {
    CHECK_NOTHROW(parse_json(nested(json_limits::depth, '[', ']'), "a"));
    CHECK_THROWS_WITH(parse_json(nested(json_limits::depth + 1, '[', ']'), "a"),
                      "a: arrays and objects within each other more than 64 deep");
    std::string objects;
    for (int i = 0; i < 60'000; ++i)
        objects += R"({"a":)";
    CHECK_THROWS_WITH(parse_json(objects, "a"), "a: arrays and objects within each other more than 64 deep");
}

TEST_CASE("json reader: so have its size and its number of values") {
    CHECK_THROWS_WITH(parse_json(std::string(json_limits::bytes + 1, ' '), "a"), "a: more than 64 MiB of JSON");
    std::string many = "[";
    for (std::size_t i = 0; i < json_limits::values; ++i)
        many += "1,";
    CHECK_THROWS_WITH(parse_json(many + "1]", "a"), "a: more than 4000000 values");
    CHECK_THROWS_WITH(read_json("/dev/zero"), "/dev/zero: more than 64 MiB of JSON");
}

TEST_CASE("json reader: a key that stands twice is reported with its place, a byte order mark is skipped") {
    CHECK_THROWS_WITH(parse_json(R"({"a": {"b": 1, "b": 2}})", "a"),
                      R"(a: /a: the key "b" stands twice in one object)");
    CHECK_THROWS_WITH(parse_json(R"({"a": [0, [], {"c": 3}, {"b": {"d": []}, "e": 1, "b": 2}]})", "a"),
                      R"(a: /a/3: the key "b" stands twice in one object)");
    CHECK(parse_json("\xef\xbb\xbf[1]", "a") == nlohmann::json{1});
}

TEST_CASE("json reader: what stands behind the value is told, NUL bytes too") {
    CHECK_THROWS_WITH(parse_json(std::string_view("{}\n\0\0", 5), "a"),
                      "a: a NUL byte behind its end, byte 4; right is the value alone");
}

TEST_CASE("json reader: a choice among numbers may be written as one") {
    const nlohmann::json two = 2, nine = 9;
    CHECK(JsonValue(two, "a").choice({"1", "2"}) == 1);
    CHECK_THROWS_WITH(JsonValue(nine, "a").choice({"1", "2"}), "a: /: 9 is not one of 1, 2");
}

TEST_CASE("json reader: a number above 0 that no float holds is told as that") {
    const nlohmann::json tiny = 1e-45;
    CHECK_THROWS_WITH(JsonValue(tiny, "a").number(number::positive),
                      "a: /: 1e-45 is not a normal float, which is 1.2e-38 or more");
}

TEST_CASE("json reader: a number is rounded to a float once") {
    // The first lies above the middle of 1 and the next float by less than half an ULP of a double, so that the double
    // nearest to it is the middle; the second is the middle; the third lies below one.
    const auto of = [](const std::string& text) {
        const nlohmann::json number = parse_json(text, "a");
        return JsonValue(number, "a").number();
    };
    CHECK(of("1.00000005960464477539062500001") == 0x1.000002p0F);
    CHECK(of("1.000000059604644775390625") == 1.0F);
    CHECK(of("1.00000017881393432617187499999") == 0x1.000002p0F);
    CHECK(of("-1.00000005960464477539062500001e0") == -0x1.000002p0F);
    CHECK(of("9007199791611905") == 0x1.000002p53F); // an integer, 2^53 + 2^29 + 1
    CHECK(of("3.4028234663852886e38") == std::numeric_limits<float>::max());
    CHECK(of("-3.4028235e38") == std::numeric_limits<float>::lowest());
    CHECK_THROWS_WITH(of("3.4028236e38"), Catch::Contains("beyond what a float holds"));
    const nlohmann::json list = parse_json("[0.5, 1.00000005960464477539062500001, 0.25, {\"a\": "
                                           "1.00000017881393432617187499999}]",
                                           "a");
    CHECK(list[0] == 0.5);
    CHECK(nearest_float(list[1]) == 0x1.000002p0F);
    CHECK(list[2] == 0.25);
    CHECK(nearest_float(list[3]["a"]) == 0x1.000002p0F);
}

TEST_CASE("json reader: an error does not quote a million digits") {
    try {
        parse_json(std::string(1'000'000, '9').append("e999"), "a");
        FAIL("no number so large is read");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() < 250);
    }
}

} // namespace lockstep::test::json_reader_test
