#pragma once
#include <string>

#include "crosscheck/judge/render_verdict.hpp"
#include "reference/collision/render/legal_pixels.hpp"
#include "reference/collision/render/mistakes.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// "particle 17", "triangle 3 of the obstacles", "the background".
std::string owner_text(const PixelOwner& owner);

/// What a pixel that differs is; `reference`: whose the reference's is.
DifferenceClass pixel_class(const LegalPixel& legal, const PixelOwner& reference, Rgba8 gpu);

/// Judges each pixel that differs by its legal candidates (legal_pixels.hpp): rounding, where who is seen is the same;
/// a tie, where rounding shows another; undefined; or divergent. A cause is a mistake with which the reference's own
/// image is the GPU's, but for what is legal then.
RenderVerdict judge_render(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                           const ColorImage& gpu);

} // namespace lockstep
