#pragma once
#include "reference/dust/colliders.hpp"
#include "reference/dust/cone.hpp"
#include "reference/dust/handed.hpp"

namespace lockstep {
struct FastRun;
}

namespace lockstep::dust {

/// A frame of flight: gravity, drag, colliders. Twin of shaders/dust/update.comp.
struct UpdateTwin {
    HostPtr host;
    FrameValues values = {};                 ///< of the frame
    FrameValues pulling = {};                ///< of the frame whose vacuum pulled
    std::optional<Colliders> colliders = {}; ///< instead of the host's

    [[nodiscard]] UpdateTwin at(int frame) const { return {host, host->at(frame), host->at(host->pulled_in(frame))}; }
    [[nodiscard]] UpdateTwin handed(std::span<const Mistake> made) const {
        return {host, dust::handed(*host, values, made), dust::handed(*host, pulling, made),
                handed_colliders(*host, made)};
    }

    [[nodiscard]] bool fast(const FastRun& run) const;

    template <class R, class Item> Grain<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Vec3 = typename R::Vec3;
        const Settings& settings = host->settings();
        const Switches& switches = host->switches();
        Grain<R> grain = grain_before(r, in, item);
        if (!is_alive(r, grain))
            return grain;
        const bool kills = host->update_kills(values.frame);
        const bool sucks = kills && switches.suction == Suction::force_in_update;
        const ConeTwin<R> cone(r, *host, pulling);
        const auto dt = r.uniform(site::dt, values.dt);

        Vec3 a{};
        bool sucked = false;
        if (sucks)
            if (const auto force = cone.force(grain.position)) {
                a = r.note(site::acceleration,
                           divided(r, site::acceleration, *force, r.uniform(site::mass, settings.mass)));
                sucked = true;
            }
        a = a + r.uniform(site::gravity, settings.gravity);
        const auto resistance = r.uniform(site::air_resistance, settings.air_resistance);
        if (switches.drag_step == DragStep::implicit) {
            grain.velocity = divided(r, site::drag, grain.velocity + a * dt, 1.0F + resistance * dt);
        } else {
            Vec3 drag = grain.velocity * resistance;
            if (switches.drag == Drag::by_mass)
                drag = divided(r, site::drag, drag, r.uniform(site::mass, settings.mass));
            grain.velocity = grain.velocity + (a - r.note(site::drag, drag)) * dt;
        }
        grain.velocity = r.note(site::fall, grain.velocity);

        Movement<R> m{
            grain.position,
            r.note(site::next, grain.position + r.note(site::way_of_frame, r.note(site::mover, grain.velocity) * dt)),
            grain.velocity};
        const ColliderTwin<R> answer(r, *host, colliders ? *colliders : host->colliders());
        const bool has_world = r.setting(site::has_world, true);
        if (has_world && switches.world_order == WorldOrder::first)
            answer.world(m);
        if (r.setting(site::has_colliders, true))
            answer.list(m);
        if (has_world && switches.world_order == WorldOrder::last)
            answer.world(m);
        // Nothing moved the grain since the vacuum's kernel: it pulled who is in the cone.
        Vec3 asked_at = grain.position;
        if (kills && !sucks && r.setting(site::asks_again, true)) {
            if (!r.setting(site::asks_where_it_was, true))
                asked_at = m.next;
            sucked = !r.setting(site::pulled_alone, true) || cone.force(asked_at).has_value();
        }
        if (sucked && cone.kills(asked_at, m.next))
            grain.alive = 0;
        grain.velocity = r.note(site::velocity, m.velocity);
        grain.position = r.note(site::position, m.next);
        grain.alive = r.note(site::alive, grain.alive);
        return grain;
    }
};

} // namespace lockstep::dust
