#include <catch2/catch.hpp>

#include <string>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/error.hpp"

using namespace lockstep;

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

TEST_CASE("json reader: an error does not quote a million digits") {
    try {
        parse_json(std::string(1'000'000, '9') + "e999", "a");
        FAIL("no number so large is read");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() < 250);
    }
}
