#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/collision/collision_pass.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// A texel of the neighbourhood, in the order it is looked at. The fields below `stored` are set where it is compared.
struct NeighbourTrace {
    BaseTexelIndex texel;
    bool on_image = false;
    bool holds_particle = false;
    glm::vec4 stored{0.0F}; ///< its code
    glm::vec3 position{0.0F};
    glm::vec3 apart{0.0F};
    float distance = 0.0F;
    bool compared = false; ///< not skipped as empty, outside or at distance 0
    bool became_nearest = false;
};

/// Where fixed function puts a point.
struct PointWindow {
    glm::vec3 position{0.0F}; ///< pixels; z is window depth
    glm::ivec2 snapped{0};    ///< 2^-subpixel_bits pixels from the centre of pixel 0
};

/// One particle's way through the collision pass (thesis, Fig. 3-3): where it searched, what it found, and where its
/// point was drawn.
struct StepTrace {
    ParticleState before;
    BaseTexelIndex base;   ///< x -1: outside the image
    bool searches = false; ///< collide time below 0, and a base texel
    std::optional<glm::vec3> own_position;
    std::vector<NeighbourTrace> neighbours;
    std::optional<std::size_t> nearest; ///< index into neighbours: a hit
    ParticleState after;
    glm::vec4 raster_clip{0.0F};    ///< the clip position that is drawn
    glm::vec4 point_position{0.0F}; ///< gl_Position
    PointWindow window;
    PointFragment fragment;
};

/// The gl_Position the pass makes of a clip position: with arithmetic=exact the centre of its texel; outside every clip
/// volume where the point is not to be drawn.
glm::vec4 point_position(glm::vec4 clip, const FrameParams& params);

/// What fixed function makes of a gl_Position, by the profile's rules; the texel is -1 where nothing is drawn.
PointWindow point_window(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules);
PointFragment drawn_point(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules);

/// Traces one particle; `after` has the bits update_particles gives, `fragment` those of point_fragment.
StepTrace trace_step(const ParticleState& before, const CollisionImage& cdt, const FrameParams& params,
                     const Profile& profile);

} // namespace lockstep
