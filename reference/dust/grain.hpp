#pragma once
#include <cstddef>
#include <tuple>

#include <glm/mat4x4.hpp>

#include "reference/dust/sites.hpp"
#include "reference/model/dust/schema.hpp"
#include "reference/model/dust/switches.hpp"
#include "reference/readings/decided.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

template <class R> struct AliveOf { using Type = typename R::Int; };
template <HasLanes R> struct AliveOf<R> { using Type = typename R::Index; };

template <class R> struct Grain {
    typename R::Vec3 position;
    typename AliveOf<R>::Type alive{};
    typename R::Vec3 velocity, colour;
    auto fields() const { return std::tie(position, alive, velocity, colour); }
};

/// A grain as a kernel finds it, or one of each lane.
template <class R, class Item> Grain<R> grain_before(R& r, const PassInput& in, const Item& item) {
    if constexpr (HasLanes<R>) {
        return {item_vec3(r, site::before, in.before, field::position, item), item_int(in.before, field::alive, item),
                item_vec3(r, site::speed, in.before, field::velocity, item),
                item_vec3(r, site::colour_before, in.before, field::colour, item)};
    } else {
        if constexpr (requires { r.foretell(in); })
            r.foretell(in);
        r.uniform(site::index, static_cast<int>(item));
        return {r.read(site::before, in.before.vec3(field::position, item)),
                r.uniform(site::alive_before, in.before.integer(field::alive, item)),
                r.read(site::speed, in.before.vec3(field::velocity, item)),
                r.read(site::colour_before, in.before.vec3(field::colour, item))};
    }
}

template <class R> bool is_alive(R& r, const Grain<R>& grain) { return r.decide(site::is_alive, grain.alive == 1); }

/// (x x + y y) + z z
template <class Vec> auto squared(const Vec& v) { return (v.x * v.x + v.y * v.y) + v.z * v.z; }

/// a + t (b - a)
template <class T, class S> T lerp(const T& a, const T& b, const S& t) { return a + (b - a) * t; }

/// m (v, 0), each operation rounded.
template <class R> typename R::Vec3 turned(R& r, const glm::mat4& m, const typename R::Vec3& v) {
    const bool columns = r.setting(site::by_columns, true);
    const auto at = [&](int column, int row) { return columns ? m[column][row] : m[row][column]; };
    const auto row = [&](int k) { return (v.x * at(0, k) + v.y * at(1, k)) + v.z * at(2, k); };
    return {row(0), row(1), row(2)};
}

template <class R> typename R::Vec3 divided(R& r, At place, const typename R::Vec3& v, const typename R::Real& by) {
    return {r.divide(place, v.x, by), r.divide(place, v.y, by), r.divide(place, v.z, by)};
}

/// The direction of `way`; with safe_direction that of nothing, or of NaN, is 0.
template <class R>
typename R::Vec3 direction_of(R& r, At place, const typename R::Vec3& way, const Switches& switches) {
    if (switches.safe_direction == OffOn::on && !r.decide(site::no_direction, squared(way) > 0.0F))
        return {};
    return r.normalize(place, way);
}

} // namespace lockstep::dust
