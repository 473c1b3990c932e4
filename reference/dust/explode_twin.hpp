#pragma once
#include "reference/dust/grain.hpp"
#include "reference/dust/handed.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep {
struct FastRun;
}

namespace lockstep::dust {

/// A ball of the cannon blows grains away from where it hit. Twin of shaders/dust/explode.comp.
struct ExplodeTwin {
    HostPtr host;
    std::size_t ball = 0; ///< which of the frame's
    FrameValues values = {};
    std::optional<Explosion> explosion = {}; ///< of the frame

    [[nodiscard]] ExplodeTwin at(int frame) const {
        return {host, ball, host->at(frame), handed_explosion(host->explosion(frame, ball), {}, {})};
    }
    [[nodiscard]] ExplodeTwin handed(std::span<const Mistake> made) const {
        return {host, ball, dust::handed(*host, values, made),
                handed_explosion(explosion ? &*explosion : nullptr, values, made)};
    }

    [[nodiscard]] bool fast(const FastRun& run) const;

    template <class R, class Item> Grain<R> operator()(R& r, const PassInput& in, const Item& item) const {
        Grain<R> grain = grain_before(r, in, item);
        if (!explosion || !is_alive(r, grain))
            return grain;
        const auto way =
            r.note(site::from_mouth, grain.position - r.uniform(site::explosion_position, explosion->position));
        const auto d2 = r.note(site::sqr_dist, squared(way));
        const auto range = r.uniform(site::explosion_sqr_range, explosion->sqr_range);
        if (!r.decide(site::in_range, d2 < range))
            return grain;
        const auto share = r.note(site::share, 1.0F - r.divide(site::share, d2, range));
        const auto f = r.note(site::blast, share * r.uniform(site::explosion_force, explosion->force));
        const auto n = r.note(site::blast_direction, direction_of(r, site::blast_direction, way, host->switches()));
        const auto a =
            divided(r, site::acceleration, r.note(site::force, n * f), r.uniform(site::mass, host->settings().mass));
        grain.velocity = r.note(site::velocity, grain.velocity + a * r.uniform(site::impulse_dt, values.explosion_dt));
        return grain;
    }
};

} // namespace lockstep::dust
