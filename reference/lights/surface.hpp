#pragma once
#include <memory>
#include <optional>

#include "reference/lights/made_on_asking.hpp"
#include "reference/lights/sites.hpp"
#include "reference/lights/wrong_drawing.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/pixel_boxes.hpp"
#include "reference/system/seen_triangles.hpp"

namespace lockstep::lights {

/// The obstacles before the camera.
std::shared_ptr<const LatestTriangles> obstacle_triangles(const Host& host);
/// Of each triangle the pixels that it may cover by mistake.
BoxesByTile obstacle_boxes(const Host& host, const SystemView& state, WrongDrawing how);
using WrongObstacleBoxes = MadeOnAsking<BoxesByTile, wrong_drawings>;

/// What a pixel shows.
template <class R> struct Surface { typename R::Vec3 position, normal, albedo; };

/// The obstacles at a pixel. Twin of shaders/lights/surface.glsl.
template <class R> class SurfaceTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    SurfaceTwin(R& r, const Host& host, const SystemView& state, const glm::mat4& to_clip, const BoxesByTile& boxes,
                const SeenTriangles* seen)
        : r_(r), host_(host), state_(state),
          triangles_(r, {state, field::corner_position, to_clip, host.settings().width, host.settings().height, boxes,
                         seen}) {}

    template <class Place> [[nodiscard]] std::optional<TriangleHit<R>> at(const Place& pixel) const {
        return triangles_.nearest(pixel);
    }
    [[nodiscard]] Surface<R> surface(const TriangleHit<R>& hit) const {
        return {position(hit), normal(hit), albedo(hit)};
    }
    [[nodiscard]] Vec3 position(const TriangleHit<R>& hit) const { return triangles_.position(hit); }
    [[nodiscard]] Vec3 normal(const TriangleHit<R>& hit) const {
        const auto [a, b, c] = triangles_.corners(hit.triangle);
        const Vec3 u = b - a, v = c - a;
        const Vec3 cross =
            r_.note(site::normal_sum, Vec3{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x});
        const Real length2 = (cross.x * cross.x + cross.y * cross.y) + cross.z * cross.z;
        const Real inverse = r_.divide(site::normal_length, Real(1.0F), r_.sqrt(site::normal_length, length2));
        const Vec3 n = cross * inverse, to_eye = r_.uniform(site::eye, host_.settings().camera.eye) - a;
        const Real side = (n.x * to_eye.x + n.y * to_eye.y) + n.z * to_eye.z;
        return r_.note(site::surface_normal, choose(decided(r_, site::faces_away, side < Real(0.0F)), -n, n));
    }
    [[nodiscard]] Vec3 albedo(const TriangleHit<R>& hit) const {
        return r_.read(site::albedo, state_.vec3(field::corner_albedo, 3 * static_cast<std::size_t>(hit.triangle)));
    }

  private:
    R& r_;
    const Host& host_;
    const SystemView& state_;
    DrawnTriangles<R> triangles_;
};

} // namespace lockstep::lights
