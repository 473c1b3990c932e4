#include <string>
#include <vector>

#include "crosscheck/scene/scene_fields.hpp"
#include "tests/item_bits.hpp"
#include "tests/lights/lights_run.hpp"

namespace lockstep::test::lanes_test {

namespace lights = lockstep::lights;

TEST_CASE("lights lanes: every item of every pass is that of the twin by itself") {
    using Strings = std::vector<std::string>;
    const std::string preset = GENERATE("exact", "corrected", "paper");
    const Strings values = GENERATE(
        Strings{"pipeline=deferred", "supersample=2"}, Strings{"pipeline=forward", "supersample=4", "outside=black"},
        Strings{"interpolation=trilinear8", "supersample=1"}, Strings{"interpolation=tricubic", "outside=black"},
        Strings{"interpolation=nearest", "shading=directionality", "direction_weight=attenuation",
                "attenuation=windowed", "zero_direction=isotropic"},
        Strings{"accumulate=fixed64", "gbuffer_format=rgba16f", "encoding=srgb_table"});
    CAPTURE(preset, values);
    lights::Settings s = in_preset(room(12), preset);
    s.width = 45; // no multiple of the lanes
    std::vector<SwitchValue> all = switch_values(s.switches);
    if (preset == "paper")
        set_value("accumulate=gather", "lights", all); // its sums have one order
    for (const std::string& one : values)
        set_value(one, "lights", all);
    take_values(s.switches, all);
    const lights::HostPtr host = host_of(s);
    check_item_bits(lights::system(host), Profile{}, 1);
}

} // namespace lockstep::test::lanes_test
