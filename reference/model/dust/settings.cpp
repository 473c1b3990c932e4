#include "reference/model/dust/settings.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::dust {
namespace {

template <class... Parts> void expect(bool right, fmt::format_string<Parts...> text, Parts&&... parts) {
    if (!right)
        throw Error("dust: " + fmt::format(text, std::forward<Parts>(parts)...));
}

bool is_direction(const glm::vec3& v) {
    const float squared = v.x * v.x + v.y * v.y + v.z * v.z;
    return squared > 0.0F && std::isfinite(squared);
}

void check_box(const char* name, const Box& box) {
    for (int axis = 0; axis < 3; ++axis)
        expect(box.min[axis] <= box.max[axis], "{}: min.{} is {}, above max, {}", name, "xyz"[axis], box.min[axis],
               box.max[axis]);
}

} // namespace

void check(const Settings& s) {
    expect(s.count >= 1 && s.count <= most_grains, "count is {}; right is 1 to {}, 65535 groups of 64", s.count,
           most_grains);
    expect(s.mass > 0.0F && std::isfinite(s.mass), "mass is {}; right is above 0: forces are divided by it", s.mass);
    expect(s.tick >= 0.0F && std::isfinite(s.tick), "tick is {} s; right is 0 or above", s.tick);
    expect(s.timescale >= 0.0F && s.timescale <= 1.0F, "timescale is {}; right is 0 to 1", s.timescale);
    expect(s.air_resistance >= 0.0F && std::isfinite(s.air_resistance), "air_resistance is {}; right is 0 or above",
           s.air_resistance);
    expect(s.scale > 0.0F && std::isfinite(s.scale), "scale is {}; right is above 0", s.scale);
    expect(s.elasticity >= 0.0F && s.elasticity <= 1.0F, "elasticity is {}; right is 0 to 1", s.elasticity);
    check_box("spawn", s.spawn);
    check_box("world", s.world);
    if (s.switches.random != Random::integer) {
        const float width = s.spawn.max.x - s.spawn.min.x;
        const float largest = static_cast<float>(s.count) / (width * width);
        expect(width > 0.0F && largest * 12.0F + 60.0F <= 32768.0F,
               "spawn: {} m wide in x, by which the sine hash divides; right is at least {} m, or random integer",
               width, std::sqrt(static_cast<float>(s.count) * 12.0F / 32700.0F));
    }
    expect(!s.controller.empty(), "controller: there is no keyframe; right is at least one");
    for (std::size_t k = 0; k < s.controller.size(); ++k) {
        expect(is_direction(s.controller[k].forward), "controller: keyframe {}: forward has no length", k);
        expect(k == 0 || s.controller[k].frame > s.controller[k - 1].frame,
               "controller: keyframe {} is of frame {}; right is after {}", k, s.controller[k].frame,
               k == 0 ? 0 : s.controller[k - 1].frame);
    }
    for (std::size_t k = 0; k < s.tools.size(); ++k) {
        const Tool& tool = s.tools[k];
        expect(tool.from <= tool.to, "tools: {} is on from {} to {}; right is upwards", k, tool.from, tool.to);
        expect(tool.angle > 0.0F && tool.angle <= 90.0F, "tools: {} has an angle of {} degrees; right is 0.01 to 90", k,
               tool.angle);
        expect(tool.range >= 0.0F && tool.force >= 0.0F, "tools: {} has a negative force or range", k);
    }
    for (std::size_t k = 0; k < s.colliders.size(); ++k) {
        const Collider& c = s.colliders[k];
        if (c.sphere)
            expect(c.radius > 0.0F, "colliders: sphere {} has radius {}; right is above 0", k, c.radius);
        else
            expect(c.scale.x > 0.0F && c.scale.y > 0.0F && c.scale.z > 0.0F,
                   "colliders: box {} has scale {} {} {}; right is above 0", k, c.scale.x, c.scale.y, c.scale.z);
    }
    for (std::size_t k = 0; k < s.cannon.size(); ++k)
        expect(is_direction(s.cannon[k].forward) && s.cannon[k].range > 0.0F,
               "cannon: ball {} has no direction or no range", k);
    expect(s.switches.box_kind == BoxKind::aabb || s.switches.box_detect == BoxDetect::boxed,
           "box_detect rounded goes with box_kind aabb; right for obb is boxed");
}

} // namespace lockstep::dust
