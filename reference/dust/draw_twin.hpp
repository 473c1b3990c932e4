#pragma once
#include <tuple>

#include "reference/dust/grain.hpp"
#include "reference/model/dust/drawing.hpp"

namespace lockstep::dust {

/// A corner of a grain's quad, which faces the camera, or cube. Twin of shaders/dust/draw.vert.
struct DrawTwin {
    HostPtr host;
    Drawing drawing;

    template <class R> struct Corner {
        typename R::Vec4 clip;
        typename R::Vec3 tint;
        typename R::Int drawn{};
        typename R::Vec2 texel_place;
        auto fields() const { return std::tie(clip, tint, drawn, texel_place); }
    };

    template <class R> Corner<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const std::span<const glm::vec3> mesh = corners(host->switches().mesh);
        const std::size_t grain = item / mesh.size();
        const glm::vec3 place = mesh[item % mesh.size()];
        const Real x = r.uniform(site::corner_x, place.x), y = r.uniform(site::corner_y, place.y);
        const Real z = r.uniform(site::corner_z, place.z);
        const Vec3 right = r.uniform(site::right, drawing.right), up = r.uniform(site::up, drawing.up);
        const Vec3 back = r.uniform(site::back, drawing.back);
        const Vec3 turned = r.note(site::turned, (right * x + up * y) + back * z);
        const Vec3 world = r.note(site::world_corner, turned * r.uniform(site::scale, host->settings().scale) +
                                                          r.read(site::before, in.before.vec3(field::position, grain)));
        const glm::mat4 to_clip = r.uniform(site::view_projection, drawing.view_projection);
        return {r.note(site::clip, r.transform(site::clip, to_clip, world)),
                r.note(site::tint, r.read(site::colour_before, in.before.vec3(field::colour, grain))),
                r.note(site::drawn, r.uniform(site::alive_before, in.before.integer(field::alive, grain))),
                r.note(site::texel_place, typename R::Vec2{x + Real(0.5F), y + Real(0.5F)})};
    }
};

} // namespace lockstep::dust
