#pragma once
#include <string>

#include "gpu/collision/gpu_side.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// What is wrong with the size of a state; empty: nothing, every field has `expected` particles.
std::string size_problem(const Particles& particles, std::size_t expected);
std::string size_problem(const CollisionImage& cdt, int width, int height);

/// Reads a side's state after its last frame; `cdt` stays as it is where the side has none. Throws Error unless each is
/// of the scene's size: what is not there cannot be compared, and so would agree.
void read_side(const GpuSide& gpu, const Scene& scene, Particles& particles, CollisionImage& cdt);
void read_side(const GpuSide& gpu, const Scene& scene, Particles& particles);
void read_side(const GpuSide& gpu, const Scene& scene, CollisionImage& cdt);

} // namespace lockstep
