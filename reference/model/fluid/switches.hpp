#pragma once
#include <string_view>
#include <vector>

#include "reference/model/srgb_table.hpp"

namespace lockstep::fluid {

// What the source has, what it leaves open, and what is chosen instead. Values in the order of their names.
enum class PointSize { distance, clip_w };
enum class PointScale { width_60, projection };
enum class Sprite { points, quad };
enum class Sphere { flat, ray };
enum class DepthValue { ndc, window, view };
enum class Unproject { stored, as_ndc };
enum class DepthFormat { d24, r32f };
enum class DepthFetch { linear, texel };
enum class Filter { off, gaussian, bilateral, narrow_range, curvature_flow };
enum class FilterShape { separable_vh, full2d };
enum class FilterConstants { published, metric };
enum class NarrowWeights { texcoord, pixels };
enum class NarrowFov { fixed45, camera };
enum class NarrowCleanup { off, quadrants, full };
enum class DifferencePick { nearer, smaller_step };
enum class EdgeNormal { published, facing };
enum class ThicknessKind { published, chord };
enum class ThicknessSum { blend, blend_exact, fixed };
enum class Mirror { as_published, incident };
enum class SceneFetch { linear, bilinear, nearest };
enum class SceneDepth { ignore, test };
enum class Transcendentals { builtin, portable };
using lockstep::Encoding;

/// The preset `corrected`.
struct Switches {
    PointSize point_size = PointSize::clip_w;        ///< what a sprite's size is divided by
    PointScale point_scale = PointScale::projection; ///< width_60: W / tan 30 degrees, whatever the camera's angle
    Sprite sprite = Sprite::quad;
    Sphere sphere = Sphere::flat;                 ///< ray: where the pixel's ray meets the sphere
    DepthValue depth_value = DepthValue::view;    ///< what the depth images hold
    Unproject unproject = Unproject::stored;      ///< as_ndc: what is stored is taken for NDC depth
    DepthFormat depth_format = DepthFormat::r32f; ///< d24: rounded to codes of 24 bits, by the shaders
    DepthFetch depth_fetch = DepthFetch::texel;
    Filter filter = Filter::bilateral;
    FilterShape filter_shape = FilterShape::separable_vh; ///< of gaussian and bilateral
    FilterConstants filter_constants = FilterConstants::metric;
    NarrowWeights narrow_weights = NarrowWeights::pixels;
    NarrowFov narrow_fov = NarrowFov::camera;
    NarrowCleanup narrow_cleanup = NarrowCleanup::full;
    DifferencePick difference_pick = DifferencePick::smaller_step;
    EdgeNormal edge_normal = EdgeNormal::facing;
    ThicknessKind thickness_kind = ThicknessKind::chord;
    ThicknessSum thickness_sum = ThicknessSum::blend;
    Mirror mirror = Mirror::incident;
    SceneFetch scene_fetch = SceneFetch::bilinear;
    SceneDepth scene_depth = SceneDepth::test;
    Transcendentals transcendentals = Transcendentals::portable;
    Encoding encoding = Encoding::srgb_table;

    /// Whether a pass leaves the filtering of a texture to GL.
    [[nodiscard]] bool filters_by_gl() const {
        return depth_fetch == DepthFetch::linear || scene_fetch == SceneFetch::linear;
    }

    bool operator==(const Switches&) const = default;
};

/// Calls `visit(name, value, {names of the values})` for every switch.
template <class S, class Visit> void for_each_switch(S& s, const Visit& visit) {
    using Names = std::vector<std::string_view>;
    visit("point_size", s.point_size, Names{"distance", "clip_w"});
    visit("point_scale", s.point_scale, Names{"width_60", "projection"});
    visit("sprite", s.sprite, Names{"points", "quad"});
    visit("sphere", s.sphere, Names{"flat", "ray"});
    visit("depth_value", s.depth_value, Names{"ndc", "window", "view"});
    visit("unproject", s.unproject, Names{"stored", "as_ndc"});
    visit("depth_format", s.depth_format, Names{"d24", "r32f"});
    visit("depth_fetch", s.depth_fetch, Names{"linear", "texel"});
    visit("filter", s.filter, Names{"off", "gaussian", "bilateral", "narrow_range", "curvature_flow"});
    visit("filter_shape", s.filter_shape, Names{"separable_vh", "full2d"});
    visit("filter_constants", s.filter_constants, Names{"published", "metric"});
    visit("narrow_weights", s.narrow_weights, Names{"texcoord", "pixels"});
    visit("narrow_fov", s.narrow_fov, Names{"fixed45", "camera"});
    visit("narrow_cleanup", s.narrow_cleanup, Names{"off", "quadrants", "full"});
    visit("difference_pick", s.difference_pick, Names{"nearer", "smaller_step"});
    visit("edge_normal", s.edge_normal, Names{"published", "facing"});
    visit("thickness_kind", s.thickness_kind, Names{"published", "chord"});
    visit("thickness_sum", s.thickness_sum, Names{"blend", "blend_exact", "fixed"});
    visit("mirror", s.mirror, Names{"as_published", "incident"});
    visit("scene_fetch", s.scene_fetch, Names{"linear", "bilinear", "nearest"});
    visit("scene_depth", s.scene_depth, Names{"ignore", "test"});
    visit("transcendentals", s.transcendentals, Names{"builtin", "portable"});
    visit("encoding", s.encoding, Names{"linear8", "srgb_hw", "srgb_table"});
}

/// paper, corrected or exact. Throws Error naming them for any other name.
Switches preset(std::string_view name);

} // namespace lockstep::fluid
