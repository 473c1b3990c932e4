#pragma once
#include "reference/dust/grain.hpp"
#include "reference/dust/handed.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep {
struct FastRun;
}

namespace lockstep::dust {

/// A cone of wind. Twin of shaders/dust/blow_wind.comp.
struct BlowWindTwin {
    HostPtr host;
    FrameValues values = {}; ///< of the frame

    [[nodiscard]] BlowWindTwin at(int frame) const { return {host, host->at(frame)}; }
    [[nodiscard]] BlowWindTwin handed(std::span<const Mistake> made) const {
        return {host, dust::handed(*host, values, made)};
    }

    [[nodiscard]] bool fast(const FastRun& run) const;

    template <class R, class Item> Grain<R> operator()(R& r, const PassInput& in, const Item& item) const {
        Grain<R> grain = grain_before(r, in, item);
        if (!is_alive(r, grain))
            return grain;
        const auto way =
            r.note(site::from_mouth, grain.position - r.uniform(site::controller_pos, values.controller_pos));
        const auto d2 = r.note(site::sqr_dist, squared(way));
        if (!r.decide(site::in_range, d2 < r.uniform(site::blower_sqr_dist, values.sqr_range)))
            return grain;
        if (host->switches().safe_direction == OffOn::on && !r.decide(site::no_direction, d2 > 0.0F))
            return grain;
        const auto n = r.note(site::from_mouth_unit, r.normalize(site::from_mouth_unit, way));
        const auto k =
            r.note(site::along, r.dot(site::along, r.uniform(site::controller_forward, values.controller_forward), n));
        if (!r.decide(site::in_cone, k > r.uniform(site::blower_threshold, values.threshold)))
            return grain;
        const auto d = host->switches().blow_falloff == BlowFalloff::square
                           ? d2
                           : r.note(site::distance, r.sqrt(site::distance, d2));
        const auto push =
            r.note(site::pull, r.divide(site::pull, r.uniform(site::blower_sqr_force, values.sqr_force), d));
        const auto force = r.note(site::force, (n * push) * r.note(site::force_along, k));
        const auto a = divided(r, site::acceleration, force, r.uniform(site::mass, host->settings().mass));
        grain.velocity = r.note(site::velocity, grain.velocity + a * r.uniform(site::impulse_dt, values.wind_dt));
        return grain;
    }
};

} // namespace lockstep::dust
