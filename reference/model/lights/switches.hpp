#pragma once
#include <string_view>
#include <vector>

#include "reference/model/srgb_table.hpp"

namespace lockstep::lights {

// What the source leaves open, and what is chosen instead. Values in the order of their names.
enum class Influence { radius, own_voxel };
enum class Attenuation { none, smooth, windowed };
enum class Direction { raw, unit };
enum class DirectionWeight { one, attenuation };
enum class VoxelPoint { corner, centre };
enum class ZeroDistance { undefined, skip };
enum class ZeroDirection { undefined, unlit, isotropic };
enum class Shading { single, directionality };
enum class Accumulate { float_atomic, float_cas, blend, blend_exact, fixed32, fixed64, gather, racing };
enum class Format { rgba32f, rgba16f };
enum class Interpolation { nearest, trilinear_hw, trilinear, trilinear8, tricubic };
enum class Supersample { one, two, four };
enum class Outside { clamp, black };
enum class Pipeline { forward, deferred };
enum class Motion { still, bounce };
using lockstep::Encoding;
enum class OffOn { off, on };

/// The preset `corrected`.
struct Switches {
    Influence influence = Influence::radius;
    Attenuation attenuation = Attenuation::windowed; ///< of a light's colour with its distance s^(1/2), s in m^2
    Direction direction = Direction::unit;           ///< of what is summed: from the voxel to the light
    DirectionWeight direction_weight = DirectionWeight::attenuation;
    VoxelPoint voxel_point = VoxelPoint::centre;
    ZeroDistance zero_distance = ZeroDistance::skip;     ///< a light on a voxel's point
    ZeroDirection zero_direction = ZeroDirection::unlit; ///< where the sampled direction is 0
    Shading shading = Shading::single; ///< directionality: as much of an even light as directions cancelled
    Accumulate accumulate = Accumulate::gather;
    Format volume_format = Format::rgba32f; ///< of both textures; halves are rounded by the shader
    Interpolation interpolation = Interpolation::trilinear;
    Supersample supersample = Supersample::two; ///< samples a pixel along each axis of a voxel
    Outside outside = Outside::black;
    Pipeline pipeline = Pipeline::deferred;
    Format gbuffer_format = Format::rgba32f; ///< of position and normal; halves are rounded by the shader
    Motion motion = Motion::bounce;
    Encoding encoding = Encoding::srgb_table;
    OffOn glow = OffOn::on;

    bool operator==(const Switches&) const = default;
};

/// Calls `visit(name, value, {names of the values})` for every switch.
template <class S, class Visit> void for_each_switch(S& s, const Visit& visit) {
    using Names = std::vector<std::string_view>;
    visit("influence", s.influence, Names{"radius", "own_voxel"});
    visit("attenuation", s.attenuation, Names{"none", "smooth", "windowed"});
    visit("direction", s.direction, Names{"raw", "unit"});
    visit("direction_weight", s.direction_weight, Names{"one", "attenuation"});
    visit("voxel_point", s.voxel_point, Names{"corner", "centre"});
    visit("zero_distance", s.zero_distance, Names{"undefined", "skip"});
    visit("zero_direction", s.zero_direction, Names{"undefined", "unlit", "isotropic"});
    visit("shading", s.shading, Names{"single", "directionality"});
    visit("accumulate", s.accumulate,
          Names{"float_atomic", "float_cas", "blend", "blend_exact", "fixed32", "fixed64", "gather", "racing"});
    visit("volume_format", s.volume_format, Names{"rgba32f", "rgba16f"});
    visit("interpolation", s.interpolation, Names{"nearest", "trilinear_hw", "trilinear", "trilinear8", "tricubic"});
    visit("supersample", s.supersample, Names{"1", "2", "4"});
    visit("outside", s.outside, Names{"clamp", "black"});
    visit("pipeline", s.pipeline, Names{"forward", "deferred"});
    visit("gbuffer_format", s.gbuffer_format, Names{"rgba32f", "rgba16f"});
    visit("motion", s.motion, Names{"still", "bounce"});
    visit("encoding", s.encoding, Names{"linear8", "srgb_hw", "srgb_table"});
    visit("glow", s.glow, Names{"off", "on"});
}

/// paper, corrected or exact. Throws Error naming them for any other name.
Switches preset(std::string_view name);

/// Samples along an axis: 1, 2 or 4.
inline int samples(Supersample s) { return s == Supersample::one ? 1 : s == Supersample::two ? 2 : 4; }

/// Whether lights add to words of the accumulator, which a pass of its own makes textures of.
inline bool scatters(Accumulate a) {
    return a != Accumulate::gather && a != Accumulate::blend && a != Accumulate::blend_exact;
}
inline bool blends(Accumulate a) { return a == Accumulate::blend || a == Accumulate::blend_exact; }
/// Whether the words are floats, added in an order that nothing fixes.
inline bool adds_floats(Accumulate a) {
    return a == Accumulate::float_atomic || a == Accumulate::float_cas || a == Accumulate::racing;
}

} // namespace lockstep::lights
