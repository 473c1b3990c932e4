#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reference/collision/collision_pass.hpp"

namespace lockstep {

/// The collision pass, faster: the bits of collision_pass.hpp for every switch, profile and thread count, any NaN
/// counting as any other. Same arguments, same answers; collision_pass.hpp is the one to read.

void update_particles_fast(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                           const Profile& profile, Particles& after);

void rasterise_particles_fast(const Particles& before, const Particles& after, const FrameParams& params,
                              const Profile& profile, CollisionImage& cdt, DepthImage& depth);

/// What drawing needs beside its image: kept from one drawing to the next, it is not allocated again.
struct DrawingScratch {
    std::unique_ptr<std::uint64_t[]> keys;
    std::size_t size = 0;
};

/// The same with memory of the caller's. `texels`: empty, or one a point, to be filled as point_texels_fast fills it.
void draw_particles_fast(const Particles& before, const Particles& after, const FrameParams& params,
                         const Profile& profile, CollisionImage& cdt, DepthImage& depth, DrawingScratch& scratch,
                         std::span<std::int32_t> texels);

/// The texels that point_fragment() gives, one a position, in parallel; no_texel where it draws none.
void point_texels_fast(std::span<const glm::vec3> positions, const FrameParams& params, const Profile& profile,
                       std::span<std::int32_t> texels);

} // namespace lockstep
