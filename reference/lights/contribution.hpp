#pragma once
#include <array>
#include <cmath>
#include <optional>

#include <glm/vec3.hpp>

#include "reference/lights/sites.hpp"
#include "reference/lights/step_twin.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lights {

/// A voxel's index along each axis.
struct Voxel {
    int x = 0, y = 0, z = 0;

    static Voxel of(const Grid& grid, std::size_t index) {
        const auto nx = static_cast<std::size_t>(grid.size.x), ny = static_cast<std::size_t>(grid.size.y);
        return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny), static_cast<int>(index / (nx * ny))};
    }
    [[nodiscard]] std::size_t index(const Grid& grid) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.size.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(grid.size.x) +
               static_cast<std::size_t>(x);
    }
};

/// The cell of a light, of the grid or beside it: floor((p - O) / h) per axis.
inline Voxel cell_of(const Grid& grid, const glm::vec3& p) {
    const auto along = [&](int axis) {
        return static_cast<int>(std::floor((p[axis] - grid.origin[axis]) * (1.0F / grid.voxel)));
    };
    return {along(0), along(1), along(2)};
}
/// The nearest one of the grid.
inline Voxel clamped_cell(const Grid& grid, Voxel v) {
    const auto clamped = [](int i, int n) { return i < 0 ? 0 : i >= n ? n - 1 : i; };
    return {clamped(v.x, grid.size.x), clamped(v.y, grid.size.y), clamped(v.z, grid.size.z)};
}

/// c(v) = O + (v + o) h.
template <class R> typename R::Vec3 voxel_point(R& r, const Host& host, const Voxel& v) {
    const auto o = r.uniform(site::offset, host.point_offset());
    const auto h = r.uniform(site::voxel_size, host.grid().voxel);
    const auto x = r.note(site::voxel_x, R::real(v.x)), y = r.note(site::voxel_y, R::real(v.y)),
               z = r.note(site::voxel_z, R::real(v.z));
    const typename R::Vec3 origin = r.uniform(site::low, host.grid().origin);
    return r.note(site::voxel_point,
                  typename R::Vec3{origin.x + (x + o) * h, origin.y + (y + o) * h, origin.z + (z + o) * h});
}

/// What a light adds to a voxel: colour, direction and weight, and 1 to the count. Twin of shaders/lights/light.glsl.
template <class R> struct Contribution {
    typename R::Vec3 colour, direction;
    typename R::Real weight;

    [[nodiscard]] std::array<typename R::Real, 7> channels() const {
        return {colour.x, colour.y, colour.z, direction.x, direction.y, direction.z, weight};
    }
};

/// Nothing where the light does not reach the voxel.
template <class R> std::optional<Contribution<R>> contribution(R& r, const Host& host, const SystemView& state,
                                                               std::size_t light, const typename R::Vec3& point,
                                                               const Voxel& v) {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    const Switches& on = host.switches();
    const glm::vec3 at = state.vec3(field::light_position, light);
    if (r.setting(site::by_own_voxel, on.influence == Influence::own_voxel)) {
        const Voxel own = cell_of(host.grid(), at);
        if (!r.decide(site::own_voxel, own.x == v.x && own.y == v.y && own.z == v.z))
            return {};
    }
    const Vec3 q = r.note(site::to_light, r.read(site::before, at) - point);
    const Real s = r.note(site::squared, (q.x * q.x + q.y * q.y) + q.z * q.z);
    const Real range = r.read(site::range_before, state.real(field::range, light));
    if (!r.decide(site::in_range, s <= r.note(site::range2, range * range)))
        return {};
    Real w(1.0F);
    if (on.attenuation != Attenuation::none) {
        const Real t = r.note(site::ratio, s * r.read(site::inv_range2, state.real(field::inv_range2, light)));
        if (on.attenuation == Attenuation::smooth) {
            const Real k = r.note(site::falloff, Real(1.0F) - t);
            w = k * k;
        } else {
            const Real k = r.note(site::falloff, Real(1.0F) - t * t);
            w = r.divide(site::attenuation, k * k, r.note(site::denominator, s + Real(1.0F)));
        }
    }
    w = r.note(site::attenuation, w);
    const Vec3 c = r.read(site::colour_before, state.vec3(field::light_colour, light));
    Contribution<R> made{r.note(site::light_colour, c * w), {}, w};
    Vec3 d = q;
    if (on.direction == Direction::unit) {
        if (r.setting(site::on_the_point, on.zero_distance == ZeroDistance::skip))
            if (r.decide(site::on_the_point, s == Real(0.0F)))
                return made;
        const Real inverse = r.note(site::inverse, r.divide(site::inverse, Real(1.0F), r.sqrt(site::distance, s)));
        d = r.note(site::unit, q * inverse);
    }
    if (on.direction_weight == DirectionWeight::attenuation)
        d = d * r.note(site::weight, w);
    made.direction = r.note(site::light_direction, d);
    return made;
}

/// The voxels that a light may reach: those that its ball touches, and one more to each side.
struct VoxelBox {
    Voxel low, high; ///< both in it; none where low is above high
};

inline VoxelBox box_of(const Host& host, const SystemView& state, std::size_t light) {
    const Grid& grid = host.grid();
    const glm::vec3 p = state.vec3(field::light_position, light);
    const float range = state.real(field::range, light);
    const auto end = [&](int axis, float to, float more) {
        const float at = std::floor((to - grid.origin[axis]) * (1.0F / grid.voxel)) + more;
        return static_cast<int>(std::fmin(std::fmax(at, -1.0F), static_cast<float>(grid.size[axis])));
    };
    const auto low = [&](int axis) { return std::max(end(axis, p[axis] - range, -1.0F), 0); };
    const auto high = [&](int axis) { return std::min(end(axis, p[axis] + range, 1.0F), grid.size[axis] - 1); };
    return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

/// Calls `add(voxel's index, contribution)` for each light of `order` and each voxel that it reaches.
template <class R, class Add>
void scatter(R& r, const Host& host, const SystemView& state, const std::vector<std::uint32_t>& order, const Add& add) {
    for (const std::uint32_t light : order) {
        const VoxelBox box = box_of(host, state, light);
        for (int z = box.low.z; z <= box.high.z; ++z)
            for (int y = box.low.y; y <= box.high.y; ++y)
                for (int x = box.low.x; x <= box.high.x; ++x) {
                    const Voxel v{x, y, z};
                    if (const auto made = contribution(r, host, state, light, voxel_point(r, host, v), v))
                        add(v.index(host.grid()), *made);
                }
    }
}

} // namespace lockstep::lights
