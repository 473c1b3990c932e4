#pragma once
#include <cstddef>
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/lights/host.hpp"

namespace lockstep::lights {

/// The shaders of a frame with their uniforms, in the order of its twins.
std::vector<GlPass> passes(const HostPtr& host);

/// Passes that make nothing but as many atomics as its lights make in the accumulator at the start: spread at random,
/// and in one voxel. None where lights are not added by atomics of whole numbers.
struct AtomicsAlone {
    std::vector<GlPass> passes;
    std::size_t voxels_each = 0; ///< of a light, the mean
    int words = 0;               ///< of a voxel
};
AtomicsAlone atomics_alone(const HostPtr& host);

} // namespace lockstep::lights
