#include "reference/fluid/sprite.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "reference/parallel_blocks.hpp"

namespace lockstep::fluid {
namespace {

/// The pixels of a ray's sphere: its corners' slopes (Mara and McGuire, "2D polyhedral bounds of a clipped,
/// perspective-projected 3D sphere", 2013).
PixelRect ray_box(const Host& host, const RoughWindow& window, const glm::dvec3& c, double radius) {
    const double q = -c.z, r2 = radius * radius, below = q * q - r2;
    if (!(below > 0.0))
        return {};
    const auto bound = [&](double along, double sign) {
        return (along * q + sign * radius * std::sqrt(along * along + below)) / below;
    };
    const glm::dmat4 p(host.projection());
    const auto place = [&](double x, double y) {
        return glm::dvec2((x * p[0][0] + 1.0) * 0.5 * window.width, (y * p[1][1] + 1.0) * 0.5 * window.height);
    };
    return window.box(place(bound(c.x, -1.0), bound(c.y, -1.0)), place(bound(c.x, 1.0), bound(c.y, 1.0)));
}

/// How far from its place in double a pass may find a sphere, pixels: its place p in the world and c in view space are
/// sums of four products in floats, and so is its place in the window.
double rounding(const Host& host, const glm::dvec3& p, const glm::dvec3& c) {
    const auto size = [](const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
    const Settings& s = host.settings();
    const glm::dmat4 projection(host.projection());
    const double w = -c.z, away = 0x1p-21 * (size(p) + size(glm::dvec3(host.view()[3]))) / w,
                 beside = 1.0 + (std::abs(c.x) + std::abs(c.y)) / w,
                 scale = std::max(s.width * projection[0][0], s.height * projection[1][1]);
    return scale * beside * (away + 0x1p-21);
}

} // namespace

Tried tried_with(std::span<const Mistake> made, std::size_t spheres) {
    constexpr std::size_t few = 256;
    static constexpr std::array placing{
        site::before.id,      site::view.id,         site::centre.id,   site::w.id,       site::near.id,
        site::beyond_near.id, site::radius.id,       site::distance.id, site::size.id,    site::half.id,
        site::point_scale.id, site::sprite_scale.id, site::p00.id,      site::p11.id,     site::width.id,
        site::height.id,      site::place_x.id,      site::place_y.id,  site::nx.id,      site::ny.id,
        site::window_x.id,    site::window_y.id,     site::pixel_x.id,  site::pixel_y.id, site::drawn_size.id,
        site::view_moves.id,  site::sized_by_w.id};
    const bool places = std::ranges::any_of(
        made, [](const Mistake& mistake) { return std::ranges::find(placing, mistake.site) != placing.end(); });
    return !places ? Tried::in_their_boxes : spheres <= few ? Tried::everywhere : Tried::around_them;
}

BoxesByTile sprite_boxes(const Host& host, const SystemView& state, const Spheres& spheres, double beside) {
    const Settings& s = host.settings();
    const glm::dmat4 view(host.view());
    const auto box_of = [&](std::size_t i) -> PixelRect {
        const glm::vec3 p(state.vec4(field::position, i));
        const glm::dvec3 c(view * glm::dvec4(glm::dvec3(p), 1.0));
        const auto drawn_size = [&](double size) {
            const PointSizes& sizes = host.points().sizes;
            return host.switches().sprite != Sprite::points
                       ? size
                       : std::clamp(size, double{sizes.smallest}, double{sizes.largest});
        };
        const double away = host.switches().point_size == PointSize::clip_w ? -c.z : glm::length(c);
        if (!(-c.z > 0.5 * double{host.near_plane()}))
            return {};
        // Pixels are met at their middles, half a pixel from their sides. A sprite's middle and its side are open to a
        // tenth of a pixel at most (point_coord.hpp).
        const RoughWindow window{glm::dmat4(host.view_projection()), s.width, s.height,
                                 -0.5 + 0.1 + rounding(host, glm::dvec3(p), c) + beside};
        if (spheres.shape == Sphere::ray)
            return ray_box(host, window, c, double{spheres.radius});
        return window.disc(window.place(window.clip(p)),
                           0.5 * drawn_size(double{host.point_scale()} * spheres.radius / away));
    };
    std::vector<PixelRect> all(state[particle_buffer].count());
    parallel_ranges(all.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            all[i] = box_of(i);
    });
    return {std::move(all), s.width, s.height};
}

const BoxesByTile& BoxesAround::of(const Host& host, const SystemView& state, const Spheres& spheres) {
    std::call_once(made_, [&] { boxes_ = sprite_boxes(host, state, spheres, room); });
    return boxes_;
}

} // namespace lockstep::fluid
