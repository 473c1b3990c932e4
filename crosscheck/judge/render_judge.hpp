#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "reference/collision/render/mistakes.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// One pixel of the rendered frame.
struct PixelDifference {
    std::size_t index = 0; ///< row by row from the bottom
    Rgba8 reference, gpu;
    PixelOwner owner; ///< whose the reference's is
};

/// The rendered frame of one state, as the GPU and the reference draw it, and what the pixels that differ are.
struct RenderVerdict {
    int frame = 0;
    int width = 0; ///< pixels of a row
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;
    std::uint64_t of_particles = 0; ///< pixels in which the reference shows a particle
    std::array<std::uint64_t, class_names.size()> classes{};
    std::optional<PixelDifference> first;  ///< the first divergent pixel, else the first undefined one
    std::vector<RenderMistakeInfo> causes; ///< each explains the whole frame; best first

    [[nodiscard]] std::uint64_t count(DifferenceClass kind) const { return classes[static_cast<std::size_t>(kind)]; }
};

/// Whether it is as GL allows; `allow_undefined`: what rests on what GL leaves open may be anything.
bool passes(const RenderVerdict& verdict, bool allow_undefined);

/// Judges each pixel that differs by its legal candidates (legal_pixels.hpp): rounding, where who is seen is the same;
/// a tie, where rounding shows another; undefined; or divergent. A cause is a mistake with which the reference's own
/// image is the GPU's, but for what is legal then.
RenderVerdict judge_render(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                           const ColorImage& gpu);

} // namespace lockstep
