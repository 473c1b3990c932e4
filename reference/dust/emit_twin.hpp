#pragma once
#include "reference/dust/handed.hpp"
#include "reference/dust/random.hpp"
#include "reference/readings/constant_divisor.hpp"

namespace lockstep::dust {

/// Gives a dead grain one chance in a hundred to come out of the emitter. Twin of shaders/dust/emit.comp.
struct EmitTwin {
    HostPtr host;
    FrameValues values = {}; ///< of the frame

    [[nodiscard]] EmitTwin at(int frame) const { return {host, host->at(frame)}; }
    [[nodiscard]] EmitTwin handed(std::span<const Mistake> made) const {
        return {host, dust::handed(*host, values, made)};
    }

    template <class R> Grain<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const auto i = static_cast<std::uint32_t>(item);
        Grain<R> grain = grain_before(r, in, item);
        if (is_alive(r, grain))
            return grain;
        const bool integer = host->switches().random == Random::integer;
        const RandomTwin<R> random(r, host->switches(), {i, seed_of(r, *host)});
        const auto frame = static_cast<std::uint32_t>(values.frame);
        const Real f = R::real(i);
        const Real chance =
            integer ? random.unit(Stream::chance, frame)
                    : random.r11(divided_by(r, site::seed, f + r.uniform(site::time, values.time), 79238.288F));
        if (!r.decide(site::is_lucky, r.note(site::chance, chance) <= 0.01F))
            return grain;
        const bool by_time = host->switches().emit_seed == EmitSeed::index_time;
        const std::uint32_t drawn_in = by_time ? frame : 0;
        Real x{}, y{}, rho{}, tangent{};
        if (integer) {
            const glm::vec2 direction = host->directions()[random.integer(Stream::angle, drawn_in) >> 20U];
            x = r.uniform(site::direction_of_table, direction.x);
            y = r.uniform(site::direction_of_table, direction.y);
            rho = random.unit(Stream::radius, drawn_in);
            tangent = r.uniform(site::emitter_tangent, values.tangent);
        } else {
            const Real s =
                r.note(site::seed,
                       divided_by(r, site::seed, by_time ? f + r.uniform(site::time, values.time) : f, 82801.277F));
            const Real turn = r.note(site::angle, lerp(Real(-6.28318530F), Real(6.28318530F), random.r11(s)));
            x = random.cosine(turn);
            y = random.sine(turn);
            rho = random.second(s);
            const Real angle = r.uniform(site::emitter_angle, values.angle_rad);
            tangent = r.note(site::tangent, r.divide(site::tangent, random.sine(angle), random.cosine(angle)));
        }
        const typename R::Vec2 circle = r.note(site::circle, typename R::Vec2{x, y});
        if (host->switches().emit_disc == EmitDisc::even)
            rho = r.sqrt(site::share_of_radius, rho);
        rho = r.note(site::share_of_radius, rho);
        const Vec3 local = r.note(site::local, Vec3{circle.x * rho * tangent, circle.y * rho * tangent, 1.0F});
        const glm::mat4 m = r.uniform(site::controller_matrix, values.controller_matrix);
        const Vec3 direction = r.note(site::emitted, turned(r, m, local));
        const float force = values.tool == nullptr ? 0.0F : values.tool->force;
        const float distance = values.tool == nullptr ? 0.0F : values.tool->distance;
        grain.velocity = direction * r.uniform(site::emitter_force, force);
        if (host->switches().emit_speed == EmitSpeed::force) {
            const Vec3 thrust = r.note(site::force, grain.velocity * r.uniform(site::emitter_dist, distance));
            grain.velocity = divided(r, site::acceleration, thrust, r.uniform(site::mass, host->settings().mass)) *
                             r.uniform(site::impulse_dt, values.tool_dt);
        }
        grain.velocity = r.note(site::velocity, grain.velocity);
        grain.position = r.note(site::position, r.uniform(site::controller_pos, values.controller_pos));
        grain.alive = r.note(site::alive, typename R::Int(1));
        return grain;
    }
};

} // namespace lockstep::dust
