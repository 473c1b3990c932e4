#pragma once
#include <optional>
#include <string>
#include <vector>

#include "reference/model/box.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/clip_space.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// Constants of the listing; the thesis gives only the collision range (spec, "Constants in the listing").
struct Constants {
    float tick = 1.0F / 60.0F;             ///< seconds a frame
    glm::vec3 gravity{0.0F, -0.98F, 0.0F}; ///< world units a second squared
    float collision_range = 0.01F;         ///< world units
    float collision_time = 0.1F;           ///< seconds a particle does not search after a hit
    int texel_collide_range = 1;           ///< neighbourhood radius, texels
    float billboard_radius = 0.004F;       ///< world units, half the side of a rendered quad
    float octree_size = 50.0F;             ///< world units, side of the octree's root (octree.hpp)
    float surface_thickness = 0.05F;       ///< world units behind a surface that are a hit, search = depth
};

/// What a host gives its passes from a frame on, where that is not the scene's.
struct FrameSettings {
    int frame = 0;
    std::optional<glm::mat4> proj_view = {};        ///< in the host's clip space
    std::optional<glm::mat4> second_proj_view = {}; ///< likewise
    Constants constants;
    float speed_factor = 0.8F;
};

/// Everything a run needs, ready to use: both sides start from this and nothing else.
struct Scene {
    std::string name;
    Particles start;                    ///< at collide_time 0 nobody searches, and frame 0 only builds the CDT
    Mesh obstacles;                     ///< all obstacles, world space, in drawing order; may be empty
    Camera camera;                      ///< render camera
    std::vector<CameraKey> camera_path; ///< motion of the render camera, sorted by frame
    Camera collision_camera;            ///< used when switches.cdt_camera is fixed
    int width = 500;                    ///< CDT, texels
    int height = 500;
    int render_width = 800; ///< rendered frame, pixels
    int render_height = 800;
    Box cdt_box; ///< the box an rgba8 CDT scales positions by
    Constants constants;
    Switches switches;
    ClipSpace clip_space;              ///< of the matrices in `frames`, and of the depth test
    std::vector<FrameSettings> frames; ///< sorted by frame
    /// The command line's words that load it again ("/scenes/lattice.json --particles 500"); empty for one made, or
    /// changed, in code. A report repeats a run by them.
    std::string origin;
};

/// What one frame's passes need besides their images and particles.
struct FrameParams {
    glm::mat4 collision_proj_view{1.0F}; ///< u_ProjView of the collision pass
    glm::mat4 second_proj_view{1.0F};    ///< the same of the second collision camera, cdt_cameras = 2
    glm::mat4 earlier_proj_view{1.0F};   ///< u_ProjView of the frame before: what the CDT that is read was drawn with
    glm::mat4 earlier_inverse{1.0F};     ///< its inverse, rounded once
    glm::mat4 render_view{1.0F};
    glm::mat4 render_projection{1.0F};
    int width = 500; ///< CDT, texels
    int height = 500;
    int render_width = 800; ///< pixels
    int render_height = 800;
    Box cdt_box;
    Constants constants;
    Switches switches;
    ClipDepth clip_depth;
};

FrameParams frame_params(const Scene& scene, int frame);

} // namespace lockstep
