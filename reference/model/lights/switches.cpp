#include "reference/model/lights/switches.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::lights {

Switches preset(std::string_view name) {
    Switches s;
    if (name == "corrected")
        return s;
    if (name == "exact") {
        s.accumulate = Accumulate::fixed64;
        return s;
    }
    if (name != "paper")
        throw Error(fmt::format("there is no preset '{}'; there are paper, corrected, exact", name));
    s.attenuation = Attenuation::none;
    s.direction_weight = DirectionWeight::one;
    s.voxel_point = VoxelPoint::corner;
    s.zero_distance = ZeroDistance::undefined;
    s.zero_direction = ZeroDirection::undefined;
    s.accumulate = Accumulate::float_cas;
    s.interpolation = Interpolation::trilinear_hw;
    s.outside = Outside::clamp;
    s.pipeline = Pipeline::forward;
    s.gbuffer_format = Format::rgba16f;
    s.encoding = Encoding::srgb_hw;
    return s;
}

} // namespace lockstep::lights
