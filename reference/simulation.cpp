#include "reference/simulation.hpp"

#include <algorithm>
#include <utility>

#include "reference/collision_pass_fast.hpp"
#include "reference/layered_collision_pass.hpp"
#include "reference/obstacle_pass.hpp"
#include "reference/octree_pass.hpp"

namespace lockstep {

ReferenceSimulation::ReferenceSimulation(const Scene& scene, Profile profile)
    : obstacles_(scene.obstacles), profile_(std::move(profile)), after_(scene.start), cdt_before_(empty_cdt(scene)),
      cdt_after_(empty_cdt(scene)), depth_(scene.width, scene.height, 1.0F) {}

void ReferenceSimulation::step_from(const Particles& before, const CollisionImage& cdt, const FrameParams& params) {
    if (has_remedies(params.switches)) {
        update_particles_layered(before, cdt, params, profile_, after_);
        draw_layered_cdt(after_, obstacles_, params, profile_, cdt_after_);
        return;
    }
    clear();
    if (params.switches.search == Search::octree)
        return octree_pass(before, obstacles_, params, profile_, after_);
    update_particles_fast(before, cdt, params, profile_, after_);
    obstacle_pass(obstacles_, params, profile_, cdt_after_, depth_);
    rasterise_particles_fast(before, after_, params, profile_, cdt_after_, depth_);
}

void ReferenceSimulation::step(const FrameParams& params) {
    std::swap(before_, after_);
    std::swap(cdt_before_, cdt_after_);
    step_from(before_, cdt_before_, params);
}

void ReferenceSimulation::clear() {
    std::fill(cdt_after_.texels.begin(), cdt_after_.texels.end(), glm::vec4(0.0F));
    std::fill(depth_.texels.begin(), depth_.texels.end(), 1.0F);
}

} // namespace lockstep
