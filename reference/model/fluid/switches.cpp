#include "reference/model/fluid/switches.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::fluid {

Switches preset(std::string_view name) {
    Switches s;
    if (name == "corrected")
        return s;
    if (name == "exact") {
        s.thickness_sum = ThicknessSum::blend_exact;
        return s;
    }
    if (name != "paper")
        throw Error(fmt::format("there is no preset '{}'; there are paper, corrected, exact", name));
    s.point_size = PointSize::distance;
    s.point_scale = PointScale::width_60;
    s.sprite = Sprite::points;
    s.depth_value = DepthValue::ndc;
    s.unproject = Unproject::as_ndc;
    s.depth_format = DepthFormat::d24;
    s.depth_fetch = DepthFetch::linear;
    s.filter_constants = FilterConstants::published;
    s.narrow_weights = NarrowWeights::texcoord;
    s.narrow_fov = NarrowFov::fixed45;
    s.narrow_cleanup = NarrowCleanup::quadrants;
    s.difference_pick = DifferencePick::nearer;
    s.edge_normal = EdgeNormal::published;
    s.thickness_kind = ThicknessKind::published;
    s.mirror = Mirror::as_published;
    s.scene_fetch = SceneFetch::linear;
    s.scene_depth = SceneDepth::ignore;
    s.transcendentals = Transcendentals::builtin;
    s.encoding = Encoding::linear8;
    return s;
}

} // namespace lockstep::fluid
