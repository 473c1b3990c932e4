#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "crosscheck/collision/judge/render_judge.hpp"
#include "reference/collision/render/legal_pixels.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// What a mistake that explains the whole frame shows in one pixel of it.
struct MistakenPixel {
    RenderCause cause;
    PixelOwner owner;
    Rgba8 color;
};

/// What may be drawn to a pixel, with a particle's square in the window.
struct DrawnHere {
    PixelFragment fragment;
    std::optional<BillboardWindow> square;
};

/// A particle's disc that a pixel's centre lies outside of.
struct NearDisc {
    std::size_t particle = 0;
    double apart = 0.0; ///< pixels from the centre to the rim; 0 or less: inside
};

/// A pixel of the rendered frame: both sides' colour, what may be drawn there, and what of it may be seen.
struct PixelTable {
    int frame = 0;
    std::size_t pixel = 0;
    int width = 0;    ///< of the frame, pixels
    PixelOwner owner; ///< whose the reference's colour is
    Rgba8 reference, gpu;
    std::optional<DifferenceClass> kind; ///< none: both have one colour
    std::vector<DrawnHere> drawn;        ///< nearest first, the background last
    std::vector<NearDisc> near;          ///< of particles that are not drawn to it; nearest first, at most 3
    std::uint64_t divergent = 0;         ///< pixels of the whole frame
    std::vector<MistakenPixel> causes;   ///< of these, best first, at most 3
};

/// `gpu`: what the GPU drew there of the particles in `inputs`; `whole`: the verdict on the frame that it is of.
PixelTable pixel_table(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                       std::size_t pixel, Rgba8 gpu, const RenderVerdict& whole);

} // namespace lockstep
