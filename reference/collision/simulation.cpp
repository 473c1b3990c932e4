#include "reference/collision/simulation.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/depth_pass.hpp"
#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/octree_pass.hpp"
#include "reference/readings/exact_floats.hpp"

namespace lockstep {
namespace {

template <class T> bool same_words(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Whether obstacle_pass draws the same in both frames.
bool see_obstacles_alike(const FrameParams& a, const FrameParams& b) {
    return a.width == b.width && a.height == b.height && same_words(a.collision_proj_view, b.collision_proj_view) &&
           same_words(a.cdt_box, b.cdt_box) && a.switches == b.switches && a.clip_depth == b.clip_depth;
}

void clear(CollisionImage& cdt, DepthImage& depth, const FrameParams& params) {
    const auto texels = static_cast<std::ptrdiff_t>(cdt.texels.size());
    const auto depths = static_cast<std::ptrdiff_t>(depth.texels.size());
#pragma omp parallel
    {
#pragma omp for schedule(static) nowait
        for (std::ptrdiff_t t = 0; t < texels; ++t)
            cdt.texels[static_cast<std::size_t>(t)] = glm::vec4(0.0F);
#pragma omp for schedule(static)
        for (std::ptrdiff_t t = 0; t < depths; ++t)
            depth.texels[static_cast<std::size_t>(t)] = params.clip_depth.cleared();
    }
}

template <class Texel> void copy(const Image<Texel>& from, Image<Texel>& to) {
    const auto texels = static_cast<std::ptrdiff_t>(from.texels.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t t = 0; t < texels; ++t)
        to.texels[static_cast<std::size_t>(t)] = from.texels[static_cast<std::size_t>(t)];
}

} // namespace

ReferenceSimulation::ReferenceSimulation(const Scene& scene, Profile profile)
    : obstacles_(scene.obstacles), profile_(std::move(profile)), after_(scene.start), cdt_before_(empty_cdt(scene)),
      cdt_after_(empty_cdt(scene)), depth_(scene.width, scene.height, 1.0F) {
    require_two_roundings();
}

void ReferenceSimulation::step_from(const Particles& before, const CollisionImage& cdt, const FrameParams& params) {
    if (has_remedies(params.switches)) {
        update_particles_layered(before, cdt, params, profile_, after_);
    } else if (params.switches.search == Search::octree) {
        octree_pass(before, obstacles_, params, profile_, after_);
    } else if (params.switches.search == Search::depth) {
        depth_pass(before, cdt, params, profile_, after_);
    } else {
        update_particles_fast(before, cdt, params, profile_, after_);
    }
    const bool draws_points = !has_remedies(params.switches) && params.switches.search == Search::cdt;
    texels_of_points_.resize(draws_points ? after_.size() : 0);
    draw(before, after_, params, cdt_after_, texels_of_points_);
}

void ReferenceSimulation::draw(const Particles& before, const Particles& after, const FrameParams& params,
                               CollisionImage& cdt) {
    draw(before, after, params, cdt, {});
}

void ReferenceSimulation::draw(const Particles& before, const Particles& after, const FrameParams& params,
                               CollisionImage& cdt, std::span<std::int32_t> texels_of_points) {
    if (has_remedies(params.switches))
        return draw_layered_cdt(after, obstacles_, params, profile_, cdt);
    if (params.switches.search == Search::octree)
        return clear(cdt, depth_, params);
    draw_obstacles(params, cdt);
    if (params.switches.search == Search::cdt)
        draw_particles_fast(before, after, params, profile_, cdt, depth_, scratch_, texels_of_points);
}

void ReferenceSimulation::step(const FrameParams& params) {
    std::swap(before_, after_);
    std::swap(cdt_before_, cdt_after_);
    step_from(before_, cdt_before_, params);
}

/// While camera and switches stay, obstacles are drawn once and copied; from the second frame on, so that a camera that
/// moves costs no copy.
void ReferenceSimulation::draw_obstacles(const FrameParams& params, CollisionImage& cdt) {
    const bool again = seen_ && !obstacles_.positions.empty() && see_obstacles_alike(*seen_, params);
    const auto draw_into = [&](CollisionImage& image, DepthImage& depth) {
        clear(image, depth, params);
        obstacle_pass(obstacles_, params, profile_, image, depth);
    };
    if (!again) {
        seen_ = params;
        keeps_obstacles_ = false;
        return draw_into(cdt, depth_);
    }
    if (!keeps_obstacles_) {
        obstacles_cdt_ = CollisionImage(params.width, params.height);
        obstacles_depth_ = DepthImage(params.width, params.height);
        draw_into(obstacles_cdt_, obstacles_depth_);
        keeps_obstacles_ = true;
    }
    copy(obstacles_cdt_, cdt);
    copy(obstacles_depth_, depth_);
}

} // namespace lockstep
