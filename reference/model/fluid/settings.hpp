#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/fluid/switches.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep::fluid {

/// The scene's own motion: y += amplitude 4 u (1 - |u|), u = 2 fract(x / length - time / period) - 1, of the start.
struct Wave {
    float amplitude = 0.0F; ///< m
    float length = 1.0F;    ///< m, above 0
    float period = 1.0F;    ///< s, above 0
};

/// What the published shading has as numbers, and presets give values.
struct ShadingNumbers {
    float thickness_floor = 0.0F; ///< the least thickness that light is taken to pass, m
    int fresnel_power = 5;        ///< 1 to 1023
    float fresnel_r0 = 0.0204F;   ///< 0 to 1
    float sky_bias = 0.0F;
};

/// All that a run of the fluid system starts from.
struct Settings {
    std::string description;
    std::uint32_t seed = 1;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    Switches switches;
    ShadingNumbers shading;
    std::vector<glm::vec3> particles;              ///< of the surface, m, in world space
    std::optional<Wave> wave;                      ///< moves them
    std::vector<std::vector<glm::vec3>> recording; ///< positions frame by frame, instead; the last one stays
    Mesh obstacles;                                ///< world space; may be empty
    Camera camera{.eye = {0.6F, 1.1F, 2.2F}, .target = {0.5F, 0.25F, 0.5F}, .fov_y = 60.0F, .far_plane = 100.0F};
    int width = 800, height = 800; ///< of the images, pixels
    float tick = 1.0F / 60.0F;     ///< s
    float radius = 0.00625F;       ///< r of a particle, m
    int filter_radius = 15;        ///< R of gaussian and bilateral, pixels, 0 to 31
    int flow_iterations = 60;      ///< of curvature_flow
    float flow_step = 0.0005F;     ///< dt of curvature_flow
};

inline constexpr std::size_t most_particles = std::size_t{1} << 21U;
inline constexpr int most_filter_radius = 31, most_flow_iterations = 1000;

/// The numbers of preset paper, corrected or exact. Throws Error as preset() does.
ShadingNumbers shading_numbers(std::string_view preset);

/// Throws Error, one line, for what no run can start from: nothing to draw, radii and planes that are no numbers above
/// 0, switches that exclude each other, a flow that is not stable, sums that a word cannot hold.
void check(const Settings& settings);

} // namespace lockstep::fluid
