#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include <glm/mat4x4.hpp>

#include "reference/readings/lanes.hpp"
#include "reference/readings/site.hpp"
#include "reference/readings/values.hpp"
#include "reference/system/item_reads.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep {

/// The places of a drawn triangle's twin.
namespace triangle_site {
inline constexpr Site corner_a{"first corner"}, corner_b{"second corner"}, corner_c{"third corner"},
    projection{"u_ProjView"}, clip{"clip"}, edge{"edge"}, edges{"edges"}, is_front{"counterclockwise"},
    is_back{"clockwise"}, is_flat{"no area"}, clip_w{"clip w"}, in_front{"in front of the camera"},
    depth_value{"depth of the pixel"}, in_depth{"between the planes"}, in_planes{"pixel between the planes"},
    nearest{"nearest triangle"}, second{"second share"}, third{"third share"}, surface_point{"surface position"};
} // namespace triangle_site

/// A triangle at a pixel that it covers.
template <class R> struct TriangleHit {
    int triangle = 0;
    typename R::Real second, third, depth;
    auto fields() { return std::tie(second, third, depth); }
    auto fields() const { return std::tie(second, third, depth); }
};

/// Of each pixel of an image what DrawnTriangles::nearest finds there (seen_triangles.hpp). As many more at the end as
/// a reading has lanes.
struct SeenTriangles {
    std::vector<std::int32_t> triangle; ///< -1: none
    std::vector<float> second, third, depth;
};

/// What triangles are drawn from.
struct TriangleScene {
    const SystemView& state;
    FieldId corners; ///< vec3, m, three items a triangle
    const glm::mat4& to_clip;
    int width, height;
    const BoxesByTile& boxes;
    const SeenTriangles* seen = nullptr; ///< what readings of many lanes look up
};

/// Triangles at a pixel: coverage and shares as shaders/triangle_interpolation.glsl computes them, with
/// COVERAGE_BY_FRAGMENT; then the nearest.
template <class R> class DrawnTriangles {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    using Vec4 = typename R::Vec4;

  public:
    DrawnTriangles(R& r, const TriangleScene& scene) : r_(r), scene_(scene) {}

    template <class Place> [[nodiscard]] std::optional<TriangleHit<R>> nearest(const Place& pixel) const {
        namespace site = triangle_site;
        if constexpr (HasLanes<R>) {
            return seen_at(first_of(pixel));
        } else {
            auto nearest = least<TriangleHit<R>>(r_, site::nearest, 1.0F);
            for (const std::uint32_t t : scene_.boxes.near(pixel))
                if (pixel.is_in(scene_.boxes.box(t)))
                    offer(projected(static_cast<int>(t)), pixel, [&](bool covered, const TriangleHit<R>& hit) {
                        if (covered)
                            nearest.offer(site::in_depth, hit.depth < Real(1.0F), hit.depth, hit);
                    });
            return nearest.take();
        }
    }
    [[nodiscard]] std::array<Vec3, 3> corners(int triangle) const {
        namespace site = triangle_site;
        return {corner(site::corner_a, triangle, 0), corner(site::corner_b, triangle, 1),
                corner(site::corner_c, triangle, 2)};
    }
    [[nodiscard]] Vec3 position(const TriangleHit<R>& hit) const {
        const auto [a, b, c] = corners(hit.triangle);
        return r_.note(triangle_site::surface_point,
                       Vec3{mixed(a.x, b.x, c.x, hit), mixed(a.y, b.y, c.y, hit), mixed(a.z, b.z, c.z, hit)});
    }

    /// A triangle in clip space, and x and y times the image's size.
    struct Projected {
        int triangle;
        std::array<Vec4, 3> clip;
        std::array<Real, 3> x, y;
    };
    [[nodiscard]] Projected projected(int triangle) const {
        namespace site = triangle_site;
        Projected made{triangle, {}, {}, {}};
        const glm::mat4 m = r_.uniform(site::projection, scene_.to_clip);
        const std::array<Vec3, 3> corner = corners(triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            made.clip[k] = r_.note(site::clip, r_.transform(site::clip, m, corner[k]));
            made.x[k] = made.clip[k].x * r_.real(scene_.width);
            made.y[k] = made.clip[k].y * r_.real(scene_.height);
        }
        return made;
    }
    /// Calls `made(covered, hit)` where the triangle may cover the pixel, between the planes.
    template <class Place, class Made> void offer(const Projected& of, const Place& pixel, const Made& made) const {
        namespace site = triangle_site;
        std::array<std::array<Real, 2>, 3> to_corner;
        const Real centre_x = r_.real(2 * pixel.x + 1 - scene_.width),
                   centre_y = r_.real(2 * pixel.y + 1 - scene_.height);
        for (std::size_t k = 0; k < 3; ++k)
            to_corner[k] = {of.x[k] - centre_x * of.clip[k].w, of.y[k] - centre_y * of.clip[k].w};
        const Real first = edge(to_corner[1], to_corner[2]), second = edge(to_corner[2], to_corner[0]),
                   third = edge(to_corner[0], to_corner[1]);
        const Real zero(0.0F), sum = r_.note(site::edges, (first + second) + third);
        const auto flat = decided(r_, site::is_flat, sum == zero);
        if (everywhere(flat))
            return;
        auto covered = decided(r_, site::is_front, first >= zero && second >= zero && third >= zero);
        if (!everywhere(covered))
            covered = covered || decided(r_, site::is_back, first <= zero && second <= zero && third <= zero);
        covered = covered && !flat;
        if (nowhere(covered))
            return;
        TriangleHit<R> hit{of.triangle, {}, {}, {}};
        hit.second = r_.note(site::second, r_.min(Real(1.0F), r_.max(zero, r_.divide(site::second, second, sum))));
        hit.third =
            r_.note(site::third, r_.min(Real(1.0F) - hit.second, r_.max(zero, r_.divide(site::third, third, sum))));
        const Real z = mixed(of.clip[0].z, of.clip[1].z, of.clip[2].z, hit),
                   w = r_.note(site::clip_w, mixed(of.clip[0].w, of.clip[1].w, of.clip[2].w, hit));
        covered = covered && decided(r_, site::in_front, w > zero);
        if (nowhere(covered))
            return;
        hit.depth = r_.note(site::depth_value, r_.divide(site::depth_value, z, w) * Real(0.5F) + Real(0.5F));
        made(covered && decided(r_, site::in_planes, hit.depth >= zero && hit.depth <= Real(1.0F)), hit);
    }

  private:
    [[nodiscard]] Vec3 corner(const Site& place, int triangle, int k) const {
        const auto i = static_cast<std::size_t>(3 * triangle + k);
        return r_.read(place, scene_.state.vec3(scene_.corners, i));
    }
    [[nodiscard]] Real edge(const std::array<Real, 2>& a, const std::array<Real, 2>& b) const {
        return r_.note(triangle_site::edge, a[0] * b[1] - b[0] * a[1]);
    }
    [[nodiscard]] static Real mixed(const Real& first, const Real& second, const Real& third,
                                    const TriangleHit<R>& hit) {
        return (first + hit.second * (second - first)) + hit.third * (third - first);
    }

    /// What seen_triangles.hpp found from a pixel on, of the triangle that the first active lane sees: lanes that see
    /// another drop out.
    [[nodiscard]] std::optional<TriangleHit<R>> seen_at(const Pixel& first) const {
        const SeenTriangles& seen = *scene_.seen;
        const std::size_t at = item_of(first.x, first.y, scene_.width);
        const auto triangle = static_cast<int>(typename R::Int(r_, lanes::loaded<IntLanes>(seen.triangle.data() + at)));
        if (triangle < 0)
            return {};
        const auto of = [&](const std::vector<float>& all) { return Real(lanes::loaded<FloatLanes>(all.data() + at)); };
        return TriangleHit<R>{triangle, of(seen.second), of(seen.third), of(seen.depth)};
    }

    R& r_;
    TriangleScene scene_;
};

} // namespace lockstep
