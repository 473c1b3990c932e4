#include <catch2/catch.hpp>

#include "reference/model/collision/switches.hpp"
#include "reference/model/error.hpp"

namespace lockstep::test::switches_test {

TEST_CASE("switches: every value of every switch is set and read back by name") {
    for (const SwitchInfo& info : switch_table()) {
        for (const std::string_view value : info.values) {
            Switches switches;
            set_switch(switches, info.name, value);
            CHECK(switch_value(switches, info.name) == value);
        }
        if (info.number != nullptr) {
            Switches switches;
            set_switch(switches, info.name, "0.1");
            CHECK(switches.*info.number == 0.1F);
            CHECK(switch_value(switches, info.name) == "0.1");
        }
    }
}

TEST_CASE("switches: the presets hold the values of the spec's table") {
    const Switches paper = preset("paper");
    CHECK(switch_value(paper, "base_texel") == "truncate");
    CHECK(switch_value(paper, "self_position") == "texel");
    CHECK(switch_value(paper, "empty_texel") == "phantom");
    CHECK(switch_value(paper, "collision_step") == "full");
    CHECK(switch_value(paper, "speed_factor") == "0.2");
    const Switches corrected = preset("corrected");
    CHECK(switch_value(corrected, "base_texel") == "floor");
    CHECK(switch_value(corrected, "self_position") == "vertex");
    CHECK(switch_value(corrected, "empty_texel") == "skip");
    CHECK(switch_value(corrected, "collision_step") == "tick");
    CHECK(switch_value(corrected, "speed_factor") == "0.8");
    CHECK(switch_value(preset("exact"), "arithmetic") == "exact");
}

TEST_CASE("switches: a wrong name or value is told with what is allowed") {
    Switches switches;
    CHECK_THROWS_WITH(set_switch(switches, "base_texle", "floor"),
                      Catch::Contains("unknown switch 'base_texle'") && Catch::Contains("base_texel"));
    CHECK_THROWS_WITH(set_switch(switches, "base_texel", "round"),
                      "switch base_texel: 'round' is not one of truncate, floor");
    CHECK_THROWS_WITH(set_switch(switches, "speed_factor", "1e50"),
                      "switch speed_factor: '1e50' is beyond what a float holds, 1.2e-38 to 3.4e38");
    CHECK_THROWS_WITH(set_switch(switches, "speed_factor", "nan"), "switch speed_factor: 'nan' is not a finite number");
    CHECK_THROWS_WITH(set_switch(switches, "speed_factor", "0.5x"),
                      "switch speed_factor: '0.5x' is not a finite number");
    CHECK_THROWS_WITH(preset("papper"),
                      "unknown preset 'papper'; the presets are listing, paper, corrected, exact; did you mean paper?");
}

} // namespace lockstep::test::switches_test
