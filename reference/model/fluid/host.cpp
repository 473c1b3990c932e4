#include "reference/model/fluid/host.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/matrix.hpp>

#include "reference/model/exponential.hpp"

namespace lockstep::fluid {
namespace {

/// Of a rigid motion: turned back, then moved back.
glm::mat4 inverse_of(const glm::mat4& view, const glm::vec3& eye) {
    glm::mat4 inverse(glm::transpose(glm::mat3(view)));
    inverse[3] = glm::vec4(eye, 1.0F);
    return inverse;
}

float weight(int j, float beta) {
    const float q = static_cast<float>(j) * beta;
    const float x = -(q * q);
    if (!(x >= least_exponent))
        return 0.0F;
    return exponential(
        x, [](float v) { return std::floor(v); },
        [](float p, float by) { return std::ldexp(p, static_cast<int>(by)); });
}

std::vector<FilterStep> steps(const Settings& s) {
    using Shape = FilterStep::Shape;
    const FilterStep across{Shape::along, {1, 0}, false}, upwards{Shape::along, {0, 1}, false},
        plane{Shape::plane, {0, 0}, false};
    std::vector<FilterStep> all;
    switch (s.switches.filter) {
    case Filter::off:
        return {};
    case Filter::gaussian:
    case Filter::bilateral:
        all = s.switches.filter_shape == FilterShape::full2d ? std::vector{plane} : std::vector{upwards, across};
        break;
    case Filter::narrow_range:
        all = {across, upwards};
        if (s.switches.narrow_cleanup != NarrowCleanup::off)
            all.push_back(plane);
        break;
    case Filter::curvature_flow:
        all.assign(static_cast<std::size_t>(s.flow_iterations), plane);
        break;
    }
    if (!all.empty())
        all.front().of_spheres = true;
    return all;
}

} // namespace

Host::Host(Settings settings, PointRules points, LinearFilter filter)
    : settings_(std::move(settings)), points_(points), linear_filter_(filter) {
    check(settings_);
    const Switches& on = settings_.switches;
    const double width = settings_.width, height = settings_.height, r = settings_.radius;
    const auto aspect = static_cast<float>(width / height);
    view_ = view_matrix(settings_.camera);
    projection_ = projection_matrix(settings_.camera, aspect);
    view_projection_ = view_projection_matrix(settings_.camera, aspect);
    inverse_view_ = inverse_of(view_, settings_.camera.eye);
    const double p00 = projection_[0][0], p11 = projection_[1][1];
    slope_ = {static_cast<float>(1.0 / p00), static_cast<float>(1.0 / p11)};
    int exponent = 0;
    const float fraction = std::frexp(settings_.camera.far_plane, &exponent);
    depth_scale_ = std::ldexp(1.0F, fraction == 0.5F ? 1 - exponent : -exponent);

    const bool by_width = on.point_scale == PointScale::width_60;
    point_scale_ = static_cast<float>(by_width ? width * std::numbers::sqrt3 : height * p11);
    const bool is_published = on.thickness_kind == ThicknessKind::published;
    thickness_radius_ = static_cast<float>(is_published ? 2.5 * r : r);
    thickness_gain_ = is_published ? 0.025F : static_cast<float>(2.0 * r);

    if (on.filter_constants == FilterConstants::published) {
        blur_scale_ = 0.1F;
        range_scale_ = 5.0F;
    } else {
        const int reach = settings_.filter_radius;
        blur_scale_ = reach == 0 ? 0.0F : static_cast<float>(3.0 / (std::numbers::sqrt2 * reach));
        range_scale_ = static_cast<float>(3.0 / (std::numbers::sqrt2 * 10.0 * r));
    }
    for (int j = 0; j <= most_filter_radius; ++j)
        weights_[static_cast<std::size_t>(j)] = weight(j, blur_scale_);
    const double slope = on.narrow_fov == NarrowFov::fixed45 ? std::numbers::sqrt2 + 1.0 : p11;
    narrow_scale_ = static_cast<float>(15.0 * (height * slope / 2.0) * r * 0.1);
    flow_scale_ = {static_cast<float>(2.0 / (width * p00)), static_cast<float>(2.0 / (height * p11))};
    filter_steps_ = steps(settings_);
}

std::vector<float> Host::positions(int frame) const {
    const auto at = static_cast<std::size_t>(std::max(frame, 0));
    const auto& recording = settings_.recording;
    const std::vector<glm::vec3>& from =
        recording.empty() ? settings_.particles : recording[std::min(at, recording.size() - 1)];
    std::vector<float> all;
    all.reserve(4 * from.size());
    for (glm::vec3 p : from) {
        if (settings_.wave) {
            const Wave& wave = *settings_.wave;
            const double place = double{p.x} / wave.length - frame * double{settings_.tick} / wave.period;
            const double u = 2.0 * (place - std::floor(place)) - 1.0;
            p.y = static_cast<float>(p.y + wave.amplitude * 4.0 * u * (1.0 - std::abs(u)));
        }
        all.insert(all.end(), {p.x, p.y, p.z, 1.0F});
    }
    return all;
}

} // namespace lockstep::fluid
