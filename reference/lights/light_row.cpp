#include "reference/lights/light_row.hpp"

#include "reference/lights/sites.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::lights {

template <class R> LightRow<R>::LightRow(const R& r, const Host& host) : r_(r), on_(host.switches()) {
    const Grid& grid = host.grid();
    const Real offset(host.point_offset()), voxel(grid.voxel);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < grid.size[axis]; ++i)
            point_[static_cast<std::size_t>(axis)].push_back(Real(grid.origin[axis]) + (R::real(i) + offset) * voxel);
}

template <class R> void LightRow<R>::take(const SystemView& state, std::size_t light) {
    const auto p = r_.read(site::before, state.vec3(field::light_position, light));
    const auto c = r_.read(site::colour_before, state.vec3(field::light_colour, light));
    light_ = {p.x, p.y, p.z};
    light_colour_ = {c.x, c.y, c.z};
    const Real range = r_.read(site::range_before, state.real(field::range, light));
    range2_ = range * range;
    inv_range2_ = r_.read(site::inv_range2, state.real(field::inv_range2, light));
}

template <class R> bool LightRow<R>::fill(int first, int last, int y, int z) {
    const Real qy = light_[1] - point_[1][static_cast<std::size_t>(y)],
               qz = light_[2] - point_[2][static_cast<std::size_t>(z)];
    const Real yy = qy * qy, zz = qz * qz;
    if (yy + zz > range2_) // nothing that is added to yy makes the sum less
        return false;
    const auto count = static_cast<std::size_t>(last - first + 1);
    const Real* const points = point_[0].data() + first;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const Real qx = light_[0] - points[i];
        squared_[i] = (qx * qx + yy) + zz;
        way_[0][i] = qx;
        way_[1][i] = qy;
        way_[2][i] = qz;
    }
    attenuate(count);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        colour_[0][i] = light_colour_[0] * weight_[i];
        colour_[1][i] = light_colour_[1] * weight_[i];
        colour_[2][i] = light_colour_[2] * weight_[i];
    }
    if (on_.direction == Direction::unit)
        direct(count);
    if (on_.direction_weight == DirectionWeight::attenuation) {
        const bool skips = on_.direction == Direction::unit && on_.zero_distance == ZeroDistance::skip;
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i) {
            const Real w = skips && squared_[i] == Real(0.0F) ? Real(1.0F) : weight_[i];
            way_[0][i] = way_[0][i] * w;
            way_[1][i] = way_[1][i] * w;
            way_[2][i] = way_[2][i] * w;
        }
    }
    return true;
}

template <class R> void LightRow<R>::attenuate(std::size_t count) {
    const Real one(1.0F);
    if (on_.attenuation == Attenuation::none) {
        weight_.fill(one);
    } else if (on_.attenuation == Attenuation::smooth) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i) {
            const Real k = one - squared_[i] * inv_range2_;
            weight_[i] = k * k;
        }
    } else {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i) {
            const Real t = squared_[i] * inv_range2_, k = one - t * t;
            weight_[i] = r_.divide(site::attenuation, k * k, squared_[i] + one);
        }
    }
}

/// Unit directions; at the light's own place 0 where the switch says so.
template <class R> void LightRow<R>::direct(std::size_t count) {
    const bool skips = on_.zero_distance == ZeroDistance::skip;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const Real s = squared_[i];
        const Real inverse = r_.divide(site::inverse, Real(1.0F), r_.sqrt(site::distance, s));
        const bool none = skips && s == Real(0.0F);
        way_[0][i] = none ? Real(0.0F) : way_[0][i] * inverse;
        way_[1][i] = none ? Real(0.0F) : way_[1][i] * inverse;
        way_[2][i] = none ? Real(0.0F) : way_[2][i] * inverse;
    }
}

template class LightRow<Values<PlainArithmetic>>;
template class LightRow<Values<Portable>>;

} // namespace lockstep::lights
