#pragma once
#include <array>
#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/model/collision/scene.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// What both sides agree on of the remedies (docs/remedies.md): the CDT as several planes of one size.
///
/// For each collision camera in turn: a plane with the obstacles, then cdt_layers planes with positions of particles.
/// With response = mutual as many planes again, which hold the velocity of the particle at the same place in the first
/// half: world units a second, coded like a position, and in alpha 1 where it will search in the next frame, else 0.
///
/// A particle is drawn to the texel it takes for its base texel, at a window depth that is a multiple of 2^-24. Layer 0
/// of a texel holds the particle nearest to the camera, layer 1 the next, and so on: by depth, of equally deep ones the
/// lower index first; what is behind the last layer is in none. Obstacles hide no particle, and particles no obstacle.
struct CdtPlanes {
    int layers = 1;
    int cameras = 1;
    bool velocities = false;

    [[nodiscard]] int a_camera() const { return 1 + layers; }
    [[nodiscard]] int obstacles(int camera) const { return camera * a_camera(); }
    [[nodiscard]] int position(int camera, int layer) const { return obstacles(camera) + 1 + layer; }
    [[nodiscard]] int velocity(int camera, int layer) const { return positions() + position(camera, layer); }
    [[nodiscard]] int positions() const { return cameras * a_camera(); } ///< planes of the first half
    [[nodiscard]] int count() const { return positions() * (velocities ? 2 : 1); }
};

CdtPlanes cdt_planes(const Switches& switches);

inline constexpr std::array<std::string_view, 4> remedy_switches{"cdt_layers", "cdt_cameras", "search_window",
                                                                 "response"};

/// Whether a remedy is on, so that the layered collision pass runs.
bool has_remedies(const Switches& switches);

/// Whether particles search as the listing does, and are drawn by its pass.
bool is_listing(const Switches& switches);

/// Whether the switch of this name says which pass runs, and not how the collision pass does.
bool chooses_pass(std::string_view switch_name);

/// Throws Error naming a switch that does not go with another. The remedies repair the corrected reading of the
/// listing and know no other, nor do all of them go together; step = compute, velocity = vector and
/// not_searching = stands are the listing's own search; search = depth needs a divide, whole texels and floats.
void check_switches(const Switches& switches);

/// Height of a scene's CDT in texels. Throws Error like check_switches. With remedies, plane p lies in rows
/// p * scene.height and up.
int cdt_height(const Scene& scene);

/// A CDT of that height, of cleared texels.
CollisionImage empty_cdt(const Scene& scene);

/// For search_window = projected: two points within the collision range of each other, the one at clip w, project to at
/// most x / (w - z) texels apart along x and y / (w - z) along y, where w > z; clip w of the two differs by at most z,
/// which has a thousandth more for what rounding makes of it.
///
/// With r the row of the matrix that gives clip x, q the one that gives w, and d the way from one point to the other,
/// ndc x moves by (r - ndc * q) . d / (w + q . d), which is largest in magnitude for ndc = -1 or 1.
glm::vec3 projected_reach(const glm::mat4& proj_view, const FrameParams& params);

/// Texels added to that on every side, for what rounding makes of a projection.
inline constexpr float window_margin = 1.0F / 64.0F;

} // namespace lockstep
