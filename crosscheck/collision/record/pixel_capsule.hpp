#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/collision/report/pixel_text.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// One pixel of the rendered frame of a run, with the particles and triangles that its verdict and its text rest on,
/// and nothing else. Judged anywhere, without GL and without the run.
struct PixelCapsule {
    Scene scene; ///< without particles and obstacles
    std::string renderer;
    std::string settings; ///< preset and changed switches
    int frame = 0;
    std::size_t pixel = 0; ///< row by row from the bottom
    Profile profile;       ///< of the driver's tables only the values that are needed, NaN elsewhere
    KnownOperations known;
    std::vector<std::uint32_t> particle_numbers, triangle_numbers; ///< in the run, in drawing order
    Particles particles, earlier;                                  ///< as drawn, and a frame before
    Mesh triangles;
    Rgba8 gpu;
    std::uint64_t divergent = 0;     ///< pixels of the whole frame
    std::vector<std::string> causes; ///< names of the mistakes that explain it
};

struct PixelCapsuleSource {
    const Scene& scene;
    std::string renderer;
    std::string settings;
    std::size_t pixel = 0;
};

/// Throws Error where the capsule alone would say other than the run.
PixelCapsule cut_pixel_capsule(const JudgedPicture& picture, const PixelCapsuleSource& source);

/// What `lockstep capsule show` prints: where it is from, and what `explain --pixel` says.
std::string capsule_text(const PixelCapsule& capsule, NumberFormat format);

PixelTable table_of(const PixelCapsule& capsule);

} // namespace lockstep
