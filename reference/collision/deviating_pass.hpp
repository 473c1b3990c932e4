#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "reference/collision/deviation.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep {

/// What a frame starts from, and what a host that mixes up its buffers may take instead. Pointers may be null where
/// there is nothing (before the first frame): a deviation that needs it then changes nothing.
struct FrameInputs {
    const Particles* before = nullptr;
    const CollisionImage* cdt = nullptr;
    const FrameParams* params = nullptr;
    const Particles* earlier = nullptr;          ///< before the frame before
    const CollisionImage* earlier_cdt = nullptr; ///< read by the frame before
    const FrameParams* earlier_params = nullptr;
    const CollisionImage* drawn_cdt = nullptr; ///< drawn by this frame
};

/// Particle `i` after the vertex stage of collision_pass.hpp with the deviations made; without any, its very bits.
ParticleState deviating_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                             const Deviations& deviations);

/// The same with mistakes that need no name.
ParticleState mistaken_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                            std::span<const Mistake> mistakes);

/// What the steps of these particles come by, each site once: mistakes_at() says what can be done wrong there.
std::vector<SeenSite> step_sites(const FrameInputs& inputs, std::span<const std::size_t> particles,
                                 const Profile& profile);

/// Draws `after` with the deviations made, on top of the obstacles' `cdt` and `depth`; without any, what
/// rasterise_particles draws. `obstacles_cdt` and depth: the CDT with nothing but the obstacles.
void deviating_draw(const FrameInputs& inputs, const Particles& after, const Profile& profile,
                    const Deviations& deviations, const CollisionImage& obstacles_cdt,
                    const DepthImage& obstacles_depth, CollisionImage& cdt);

} // namespace lockstep
