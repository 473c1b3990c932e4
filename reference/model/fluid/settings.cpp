#include "reference/model/fluid/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::fluid {
namespace {

template <class... Parts> void expect(bool right, fmt::format_string<Parts...> text, Parts&&... parts) {
    if (!right)
        throw Error("fluid: " + fmt::format(text, std::forward<Parts>(parts)...));
}

bool is_positive(float x) { return x > 0.0F && std::isfinite(x); }

void check_camera(const Camera& camera) {
    expect(is_positive(camera.near_plane) && camera.far_plane > camera.near_plane && std::isfinite(camera.far_plane),
           "camera: near {} m and far {} m; right is 0 < near < far", camera.near_plane, camera.far_plane);
    expect(camera.fov_y > 0.0F && camera.fov_y < 180.0F, "camera: fov_y is {} degrees; right is above 0, below 180",
           camera.fov_y);
}

void check_switches(const Settings& s) {
    const Switches& on = s.switches;
    expect(on.sphere == Sphere::flat || on.sprite == Sprite::quad, "sphere ray goes with sprite quad");
    expect(on.thickness_sum != ThicknessSum::fixed || on.sprite == Sprite::quad,
           "thickness_sum fixed goes with sprite quad");
    const bool is_metric = on.depth_value == DepthValue::view;
    expect(on.depth_format == DepthFormat::r32f || !is_metric,
           "depth_format d24 holds numbers from 0 to 1: it goes with depth_value ndc or window");
    expect(on.unproject == Unproject::stored || !is_metric, "unproject as_ndc goes with depth_value ndc or window");
}

void check_motion(const Settings& s) {
    expect(!s.wave || s.recording.empty(), "wave and recording: right is one of them");
    if (s.wave) {
        expect(std::isfinite(s.wave->amplitude), "wave: amplitude is {} m", s.wave->amplitude);
        expect(is_positive(s.wave->length), "wave: length is {} m; right is above 0", s.wave->length);
        expect(is_positive(s.wave->period), "wave: period is {} s; right is above 0", s.wave->period);
    }
    for (std::size_t frame = 0; frame < s.recording.size(); ++frame)
        expect(s.recording[frame].size() == s.particles.size(),
               "recording: frame {} has {} particles; right is {}, as frame 0 has", frame, s.recording[frame].size(),
               s.particles.size());
}

/// How far before the camera the nearest point of a sphere is that is drawn, over all frames.
double nearest_surface(const Settings& s) {
    const glm::dmat4 view(view_matrix(s.camera));
    const double more = s.wave ? std::abs(double{s.wave->amplitude}) : 0.0, near = s.camera.near_plane;
    double nearest = std::numeric_limits<double>::infinity();
    const auto look = [&](const std::vector<glm::vec3>& positions) {
        for (const glm::vec3& p : positions)
            if (const double w = -(view * glm::dvec4(glm::dvec3(p), 1.0)).z; w + more > near)
                nearest = std::min(nearest, std::max(w - more - double{s.radius}, near));
    };
    look(s.particles);
    for (const std::vector<glm::vec3>& frame : s.recording)
        look(frame);
    return nearest;
}

void check_flow(const Settings& s) {
    expect(s.flow_iterations >= 1 && s.flow_iterations <= most_flow_iterations,
           "flow_iterations is {}; right is 1 to {}", s.flow_iterations, most_flow_iterations);
    expect(is_positive(s.flow_step), "flow_step is {}; right is above 0", s.flow_step);
    if (s.switches.filter != Filter::curvature_flow)
        return;
    const glm::mat4 p = projection_matrix(s.camera, static_cast<float>(double(s.width) / s.height));
    const double most =
        std::min(2.0 / (double{p[0][0]} * s.width), 2.0 / (double{p[1][1]} * s.height)) * nearest_surface(s) / 2.0;
    expect(s.flow_step < most, "flow_step is {}: curvature flow is unstable from {:.3g} on, {:.3g} m before the camera",
           s.flow_step, most, nearest_surface(s));
}

} // namespace

ShadingNumbers shading_numbers(std::string_view name) {
    static_cast<void>(preset(name));
    if (name == "paper")
        return {.thickness_floor = 0.3F, .fresnel_power = 5, .fresnel_r0 = 0.05F, .sky_bias = 1.0F};
    return {};
}

void check(const Settings& s) {
    expect(!s.particles.empty() && s.particles.size() <= most_particles, "{} particles; right is 1 to {}",
           s.particles.size(), most_particles);
    expect(s.width >= 1 && s.height >= 1 && s.width <= 8192 && s.height <= 8192,
           "render: {} x {} pixels; right is 1 to 8192 a side", s.width, s.height);
    expect(s.radius > 0.000001F && s.radius <= 1000.0F, "radius is {} m; right is above 0.000001, to 1000", s.radius);
    expect(s.filter_radius >= 0 && s.filter_radius <= most_filter_radius,
           "filter_radius is {} pixels; right is 0 to {}", s.filter_radius, most_filter_radius);
    expect(s.tick >= 0.0F && std::isfinite(s.tick), "tick is {} s; right is 0 or above", s.tick);
    expect(s.shading.thickness_floor >= 0.0F && std::isfinite(s.shading.thickness_floor),
           "thickness_floor is {} m; right is 0 or above", s.shading.thickness_floor);
    expect(s.shading.fresnel_power >= 1 && s.shading.fresnel_power <= 1023, "fresnel_power is {}; right is 1 to 1023",
           s.shading.fresnel_power);
    expect(s.shading.fresnel_r0 >= 0.0F && s.shading.fresnel_r0 <= 1.0F, "fresnel_r0 is {}; right is 0 to 1",
           s.shading.fresnel_r0);
    expect(std::isfinite(s.shading.sky_bias), "sky_bias is {}; right is a number", s.shading.sky_bias);
    check_camera(s.camera);
    check_switches(s);
    check_motion(s);
    check_flow(s);
    const double addend = s.switches.thickness_kind == ThicknessKind::published ? 0.025 : 2.0 * double{s.radius};
    const double sum = static_cast<double>(s.particles.size()) * (65536.0 * addend + 1.0);
    expect(s.switches.thickness_sum != ThicknessSum::fixed || sum < 0x1p31,
           "particles: their sum is beyond a word of thickness; right is below 2^31 units of 2^-16 m, and {} of up to "
           "{} m make {}",
           s.particles.size(), addend, sum);
}

} // namespace lockstep::fluid
