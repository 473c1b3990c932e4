#include <functional>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "crosscheck/scene/scene_fields.hpp"
#include "tests/lights/lights_run.hpp"

namespace lockstep::test::passes_test {

namespace lights = lockstep::lights;

namespace {

lights::Settings with(lights::Settings s, const std::vector<std::string>& values) {
    std::vector<SwitchValue> all = switch_values(s.switches);
    for (const std::string& one : values)
        set_value(one, "lights", all);
    take_values(s.switches, all);
    return s;
}

} // namespace

TEST_CASE("lights passes: every pass of every preset agrees, or differs as GL allows") {
    if (!gl())
        return skip(gl().missing());
    const std::string preset = GENERATE("corrected", "exact", "paper");
    const CheckReport report = run_lights(in_preset(room(), preset), 3);
    CAPTURE(preset);
    INFO(report_text(report, {}));
    if (preset == "paper")
        CHECK(passes(report));
    else
        CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried.empty());
}

TEST_CASE("lights passes: every value of every switch that promises bits agrees") {
    if (!gl())
        return skip(gl().missing());
    using Strings = std::vector<std::string>;
    const Strings values = GENERATE(Strings{"accumulate=fixed64", "attenuation=smooth", "interpolation=nearest",
                                            "supersample=1", "encoding=linear8", "zero_direction=isotropic"},
                                    Strings{"accumulate=fixed32", "direction=raw", "interpolation=trilinear8",
                                            "outside=clamp", "volume_format=rgba16f"},
                                    Strings{"accumulate=blend", "voxel_point=corner", "pipeline=forward",
                                            "interpolation=tricubic", "supersample=1"},
                                    Strings{"accumulate=blend_exact", "attenuation=none", "direction_weight=one",
                                            "gbuffer_format=rgba16f", "motion=still", "glow=off"},
                                    Strings{"influence=own_voxel", "interpolation=nearest", "supersample=4"},
                                    Strings{"shading=directionality", "pipeline=forward"});
    const CheckReport report = run_lights(with(room(12), values), 2);
    INFO(fmt::format("{}", fmt::join(values, " ")) << "\n" << report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE("lights passes: sums whose order or rounding GL leaves open are legal, and their counts exact") {
    if (!gl())
        return skip(gl().missing());
    using Strings = std::vector<std::string>;
    const Strings values = GENERATE(Strings{"accumulate=float_cas"}, Strings{"accumulate=racing"},
                                    Strings{"accumulate=blend", "volume_format=rgba16f"});
    const CheckReport report = run_lights(with(room(24), values), 2);
    INFO(fmt::format("{}", fmt::join(values, " ")) << "\n" << report_text(report, {}));
    CHECK(passes(report));
}

} // namespace lockstep::test::passes_test
