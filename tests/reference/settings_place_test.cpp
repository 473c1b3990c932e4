#include "crosscheck/scene/settings_place.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "reference/model/error.hpp"

namespace lockstep::test::settings_place_test {

namespace {

std::string said(const std::string& message) {
    const nlohmann::json scene = nlohmann::json::parse(R"({
        "system": "dust", "image": [800, 600],
        "dust": {"elasticity": 2, "drag": 0.5, "tools": [{"range": 5}, {"range": -1, "angle": 90}],
                 "world": {"min": [0, 0, 7], "max": [1, 1, 1]}},
        "emitters": [{"lifetime": [2, 1], "rate": 5}, {"lifetime": [1, 2], "rate": -5}]})");
    try {
        fail_settings(JsonValue(scene, "s.json"), message);
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("settings place: a message has the JSON path of the value that it speaks of") {
    CHECK(said("dust: elasticity is 2; right is 0 to 1") ==
          "s.json: /dust/elasticity: elasticity is 2; right is 0 to 1");
    CHECK(said("dust: tools: 1 has a range of -1 m; right is above 0") ==
          "s.json: /dust/tools/1/range: tools: 1 has a range of -1 m; right is above 0");
    CHECK(said("emitter 1: rate is -5") == "s.json: /emitters/1/rate: emitter 1: rate is -5");
}

TEST_CASE("settings place: a vector's components have a place each, and numbers among its words have none") {
    CHECK(said("dust: world: min.z is 7, above max, 1") ==
          "s.json: /dust/world/min/2: world: min.z is 7, above max, 1");
    CHECK(said("dust: world: min is 0 0 7") == "s.json: /dust/world/min: world: min is 0 0 7");
    CHECK(said("emitter 0: lifetime is 2 to 1") == "s.json: /emitters/0/lifetime: emitter 0: lifetime is 2 to 1");
    CHECK(said("image: 800 x 600 pixels") == "s.json: /image: image: 800 x 600 pixels");
}

TEST_CASE("settings place: what is right is no place, and where a key stands twice it is none") {
    CHECK(said("dust: mass is 0; right is drag above 0") == "s.json: dust: mass is 0; right is drag above 0");
    CHECK(said("dust: range is -1") == "s.json: dust: range is -1");
}

} // namespace lockstep::test::settings_place_test
