#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reference/collision/collision_pass_fast.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The reference side of a run: whole frames, one after the other. Holds the scratch that a frame needs, so that a
/// long run allocates nothing. Twin of gpu/collision/simulation.hpp.
class ReferenceSimulation {
  public:
    /// `scene` outlives this, and its obstacles stay as they are.
    ReferenceSimulation(const Scene& scene, Profile profile);

    /// One frame from a given state: clear, obstacles, collision pass, or with remedies the layered one; with search =
    /// octree the octree pass and a CDT that stays empty. The answer is in particles() and cdt().
    void step_from(const Particles& before, const CollisionImage& cdt, const FrameParams& params);

    /// One frame from where the last one ended.
    void step(const FrameParams& params);

    /// The CDT that a step from `before` to `after` draws, whoever made it. particles() and cdt() stay.
    void draw(const Particles& before, const Particles& after, const FrameParams& params, CollisionImage& cdt);

    [[nodiscard]] const Particles& particles() const { return after_; }
    [[nodiscard]] const CollisionImage& cdt() const { return cdt_after_; }

    /// Where the last step drew each particle in cdt(), as point_texels_fast has it; empty where it draws none so.
    [[nodiscard]] std::span<const std::int32_t> texels_of_points() const { return texels_of_points_; }

  private:
    void draw(const Particles& before, const Particles& after, const FrameParams& params, CollisionImage& cdt,
              std::span<std::int32_t> texels_of_points);
    void draw_obstacles(const FrameParams& params, CollisionImage& cdt);

    const Mesh& obstacles_;
    Profile profile_;
    Particles before_, after_;
    CollisionImage cdt_before_, cdt_after_;
    DepthImage depth_;
    std::optional<FrameParams> seen_; ///< how the frame before saw the obstacles
    bool keeps_obstacles_ = false;    ///< they are in the next two as seen_ has them
    CollisionImage obstacles_cdt_;
    DepthImage obstacles_depth_;
    DrawingScratch scratch_;
    std::vector<std::int32_t> texels_of_points_;
};

} // namespace lockstep
