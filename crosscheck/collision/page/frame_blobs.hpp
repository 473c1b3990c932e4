#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/report/page/blob.hpp"
#include "reference/collision/owners.hpp"
#include "reference/model/box.hpp"

namespace lockstep {

/// What each particle and texel of a frame is: a DifferenceClass, or one of these.
inline constexpr std::uint8_t class_unjudged = 4; ///< differs, in a run that is not judged
inline constexpr std::uint8_t class_same = 5;

struct FrameClasses {
    std::vector<std::uint8_t> particles;
    std::vector<std::uint8_t> texels;
};

FrameClasses classes_of(const ComparedFrame& frame);

/// Both CDTs in 63 shades a component, across `box`, and the class of each texel. As read by
/// crosscheck/report_page/src/picture.js:
///   6 words             the box's corners, floats
///   bits                texels drawn by the reference
///   bytes x, y, z       of each of these, a plane a component: 1 to 63; 0: not finite
///   1 word              how many texels differ; if any:
///   bits                which
///   bytes               their classes
///   bits                which of them are drawn on the GPU
///   bytes x, y, z       of each of those
Blob picture_blob(const ComparedFrame& frame, const FrameClasses& classes, const Box& box);

/// Who drew each texel; empty where the run has no such owners (octree, remedies).
struct BothOwners {
    std::vector<std::int32_t> reference, gpu; ///< particles, or as owners.hpp says; or owner_unknown
};
inline constexpr std::int32_t owner_unknown = -3;

BothOwners owners_of(const ComparedFrame& frame, const Particles& before, const Scene& scene, const FrameParams& params,
                     const Profile& profile);

/// Texels and particles of which exact values are told.
struct Selection {
    std::vector<std::size_t> texels, particles;
};

/// All texels drawn on either side and all particles; or what differs, at most `most` of each, the worst class first.
Selection whole_frame(const ComparedFrame& frame);
Selection differing(const FrameClasses& classes, std::size_t most);

/// Their values, bit for bit. As read by crosscheck/report_page/src/detail.js:
///   2 words             numbers of texels t and particles p
///   p words, p bytes    particles, classes
///   c x p words         the reference's c components, in the order of fields; then c x p words: these XOR the
///   GPU's t words, t bytes    texels, counted row by row from the bottom; classes t words, t words    owners: the
///   reference's; these XOR the GPU's 4 x t words         the reference's x, y, z, w, the first three XOR the owner's
///   position if it is listed above: most
///                       are 0 then; and 4 x t words: these XOR the GPU's
Blob detail_blob(const ComparedFrame& frame, const FrameClasses& classes, const BothOwners& owners,
                 const Selection& selection);

} // namespace lockstep
