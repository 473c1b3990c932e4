#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reference/collision/render/mistakes.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/interval.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Who may be seen at a pixel, and the codes that each channel may then have.
struct PixelCandidate {
    PixelOwner owner = {};
    Rgba8 low = {}, high = {};
    bool open = false;             ///< rests on what GL leaves open
    Interval depth{1.0F, 1.0F};    ///< window depth
    bool sure = true;              ///< drawn to this pixel whatever the rounding
    double edge_margin = HUGE_VAL; ///< where it is not: 1/256 pixel from the pixel's centre to the silhouette

    [[nodiscard]] bool may_be(Rgba8 color) const;
};

/// The candidates of one pixel that GL allows, never none. With more than one, rounding decides.
struct LegalPixel {
    std::vector<PixelCandidate> candidates;
};

/// What may be drawn to a pixel.
struct PixelFragment {
    PixelCandidate candidate;
    std::optional<PixelOwner> hidden_by; ///< surely, whatever the rounding; none: it may be seen
};

/// For each of `pixels` (row by row from the bottom), who may be seen there and how: triangles and billboards whose
/// sides pass the pixel's centre, discs at their rim, depths that rounding can swap, and each candidate's colour in the
/// sets that GLSL's precision rules allow. What is known of the driver is the reference's (KnownOperations), in the
/// stage that it was measured in: no geometry stage was, and of a fragment stage no roots. With `arithmetic=exact`
/// there is one candidate, the reference's. `mistake`: of the pass with that mistake, whose image may be turned.
std::vector<LegalPixel> legal_pixels(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                                     std::span<const std::size_t> pixels, std::optional<RenderMistake> mistake = {});

/// All that may be drawn to one pixel, in drawing order, the background first; with `arithmetic=exact` what is seen
/// alone, its depth NaN: not told. Those that nothing hides are its legal candidates.
std::vector<PixelFragment> pixel_fragments(const RenderInputs& inputs, const Profile& profile,
                                           const KnownOperations& known, std::size_t pixel);

} // namespace lockstep
