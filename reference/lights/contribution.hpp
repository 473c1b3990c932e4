#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/lights/light_row.hpp"
#include "reference/lights/sites.hpp"
#include "reference/lights/step_twin.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/parallel_blocks.hpp"
#include "reference/subnormal_mode.hpp"
#include "reference/subnormals.hpp"
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
    const auto clamped = [](int i, int n) { return std::clamp(i, 0, n - 1); };
    return {clamped(v.x, grid.size.x), clamped(v.y, grid.size.y), clamped(v.z, grid.size.z)};
}

/// c(v) = O + (v + o) h.
template <class R> typename R::Vec3 voxel_point(R& r, const Host& host, const Voxel& v) {
    const auto o = r.uniform(site::offset, host.point_offset());
    const auto h = r.uniform(site::voxel_size, host.grid().voxel);
    const auto x = r.note(site::voxel_x, R::real(v.x)), y = r.note(site::voxel_y, R::real(v.y)),
               z = r.note(site::voxel_z, R::real(v.z));
    const auto i = r.note(site::voxel_index, typename R::Vec3{x, y, z});
    const typename R::Vec3 origin = r.uniform(site::low, host.grid().origin);
    return r.note(site::voxel_point,
                  typename R::Vec3{origin.x + (i.x + o) * h, origin.y + (i.y + o) * h, origin.z + (i.z + o) * h});
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
                return r.setting(site::point_counts, true) ? std::optional(made) : std::nullopt;
        r.read(site::way, state.vec3(field::light_direction, light));
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
    [[nodiscard]] bool has(const Voxel& v) const {
        return v.x >= low.x && v.x <= high.x && v.y >= low.y && v.y <= high.y && v.z >= low.z && v.z <= high.z;
    }
};

/// Those beside the grid among them.
inline VoxelBox unbounded_box(const Host& host, const SystemView& state, std::size_t light) {
    const Grid& grid = host.grid();
    const glm::vec3 p = state.vec3(field::light_position, light);
    const float range = state.real(field::range, light);
    const auto end = [&](int axis, float to, float more) {
        constexpr float far = 1024.0F;
        return static_cast<int>(
            std::fmin(std::fmax(std::floor((to - grid.origin[axis]) * (1.0F / grid.voxel)) + more, -far), far));
    };
    const auto low = [&](int axis) { return end(axis, p[axis] - range, -1.0F); };
    const auto high = [&](int axis) { return end(axis, p[axis] + range, 1.0F); };
    return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

inline VoxelBox box_of(const Host& host, const SystemView& state, std::size_t light) {
    const VoxelBox all = unbounded_box(host, state, light);
    const glm::ivec3 size = host.grid().size;
    return {{std::max(all.low.x, 0), std::max(all.low.y, 0), std::max(all.low.z, 0)},
            {std::min(all.high.x, size.x - 1), std::min(all.high.y, size.y - 1), std::min(all.high.z, size.z - 1)}};
}

/// Calls `layer_of(z)(voxel's index, contribution)` for each light of `order` and each voxel that it reaches: of one
/// voxel in that order, on all threads, a layer of voxels each.
template <class R, class LayerOf> void scatter(const R& r, const Host& host, const SystemView& state,
                                               const std::vector<std::uint32_t>& order, const LayerOf& layer_of) {
    std::vector<VoxelBox> boxes;
    boxes.reserve(order.size());
    std::vector<std::vector<std::uint32_t>> layers(static_cast<std::size_t>(host.grid().size.z)); // places in `order`
    for (std::uint32_t k = 0; k < order.size(); ++k) {
        boxes.push_back(box_of(host, state, order[k]));
        for (int z = boxes[k].low.z; z <= boxes[k].high.z; ++z)
            layers[static_cast<std::size_t>(z)].push_back(k);
    }
    const SubnormalMode mode = subnormal_mode();
    parallel_blocks(host.grid().size.z, [&](std::ptrdiff_t layer) {
        const FlushSubnormals guard(mode.flush_operands, mode.flush_results);
        R mine(r);
        LightRow<R> row(mine, host);
        const auto z = static_cast<int>(layer);
        auto add = layer_of(layer);
        for (const std::uint32_t k : layers[static_cast<std::size_t>(layer)]) {
            const VoxelBox& box = boxes[k];
            row.take(state, order[k]);
            for (int y = box.low.y; y <= box.high.y; ++y) {
                if (host.switches().influence == Influence::own_voxel) {
                    for (int x = box.low.x; x <= box.high.x; ++x)
                        if (const auto made = contribution(mine, host, state, order[k],
                                                           voxel_point(mine, host, {x, y, z}), {x, y, z}))
                            add(Voxel{x, y, z}.index(host.grid()), *made);
                    continue;
                }
                if (box.low.x > box.high.x || !row.fill(box.low.x, box.high.x, y, z))
                    continue;
                const std::size_t first = Voxel{box.low.x, y, z}.index(host.grid());
                for (std::size_t i = 0; i <= static_cast<std::size_t>(box.high.x - box.low.x); ++i)
                    if (row.reaches(i))
                        add(first + i, Contribution<R>{row.colour(i), row.direction(i), row.weight(i)});
            }
        }
    });
}

} // namespace lockstep::lights
