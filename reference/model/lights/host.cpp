#include "reference/model/lights/host.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lockstep::lights {

Host::Host(Settings settings, Driver driver) : settings_(std::move(settings)), driver_(driver) {
    check(settings_);
    most_bits_ = most_fixed_bits(settings_);
    float longest = 0.0F;
    for (const Light& light : settings_.lights)
        if (std::isfinite(light.range))
            longest = std::max(longest, light.range);
    reach_ = static_cast<int>(std::ceil(longest / settings_.grid.voxel)) + 1;
    aspect_ = static_cast<float>(static_cast<double>(settings_.width) / settings_.height);
    view_projection_ = view_projection_matrix(settings_.camera, aspect_);
    const double half_angle = double{settings_.camera.fov_y} * std::numbers::pi / 360.0;
    disc_scale_ = static_cast<float>(double{settings_.glow_radius} * 0.5 * settings_.height / std::tan(half_angle));
}

} // namespace lockstep::lights
