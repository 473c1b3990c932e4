#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// One pixel of the rendered frame.
struct PixelDifference {
    std::size_t index = 0; ///< row by row from the bottom
    Rgba8 reference, gpu;
    std::string owner; ///< whose the reference's is: "particle 17"
};

/// A mistake in drawing.
struct RenderCause {
    std::string name, meaning;
};

/// The rendered frame of one state, as the GPU and the reference draw it, and what the pixels that differ are.
struct RenderVerdict {
    int frame = 0;
    int width = 0; ///< pixels of a row
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;
    std::uint64_t of_particles = 0; ///< pixels in which the reference shows a particle
    std::array<std::uint64_t, class_names.size()> classes{};
    std::optional<PixelDifference> first; ///< the first divergent pixel, else the first undefined one
    std::vector<RenderCause> causes;      ///< each explains the whole frame; best first

    [[nodiscard]] std::uint64_t count(DifferenceClass kind) const { return classes[static_cast<std::size_t>(kind)]; }
};

/// Whether it is as GL allows; `allow_undefined`: what rests on what GL leaves open may be anything.
inline bool passes(const RenderVerdict& verdict, bool allow_undefined) {
    return verdict.count(DifferenceClass::divergent) == 0 &&
           (allow_undefined || verdict.count(DifferenceClass::undefined) == 0);
}

} // namespace lockstep
