#pragma once
#include "reference/dust/random.hpp"
#include "reference/half.hpp"

namespace lockstep::dust {

/// Places a grain in the spawn box, alive. Twin of shaders/dust/populate.comp.
struct PopulateTwin {
    HostPtr host;

    template <class R> Grain<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        const auto i = static_cast<std::uint32_t>(item);
        const auto min = r.uniform(site::spawn_min, host->settings().spawn.min);
        const auto max = r.uniform(site::spawn_max, host->settings().spawn.max);
        Grain<R> grain = grain_before(r, in, item);
        const Real f = R::real(i);
        const Real width = max.x - min.x;
        typename R::Vec3 at;
        Real shade{};
        const RandomTwin<R> random(r, host->switches(), {i, seed_of(r, *host)});
        if (host->switches().random == Random::integer) {
            at = {random.unit(Stream::position_x), random.unit(Stream::position_y), random.unit(Stream::position_z)};
            shade = random.unit(Stream::colour);
        } else {
            const Real row = r.note(site::row, r.divide(site::row, f, width));
            const Real step =
                r.note(site::step_of_row, host->switches().modulo == Modulo::fmod ? f - width * r.floor(row)
                                                                                  : (row - r.floor(row)) * width);
            if (host->switches().populate == Populate::uv) {
                const Real x = r.divide(site::seed, step, width), y = r.divide(site::seed, row, width);
                at = {random.h1(x, y), random.h1(x + 7.219F, y + 7.219F), random.h1(x + 79.714F, y + 79.714F)};
            } else {
                const Real s = r.note(site::seed, r.divide(site::seed, f, width * width));
                at = {random.r11(s), random.second(s), random.third(s)};
            }
            shade = random.r21(step, row);
        }
        at = r.note(site::triple, at);
        grain.position = {lerp(min.x, max.x, at.x), lerp(min.y, max.y, at.y), lerp(min.z, max.z, at.z)};
        if (host->switches().populate == Populate::plane)
            grain.position.y = min.y;
        grain.position = r.note(site::position, grain.position);
        grain.alive = r.note(site::alive, typename R::Int(1));
        shade = r.note(site::shade, shade);
        grain.colour = lerp(r.uniform(site::colour_a, host->settings().colour_a),
                            r.uniform(site::colour_b, host->settings().colour_b), shade);
        if (host->switches().colour_format == ColourFormat::rgb16f && r.setting(site::in_halves, true))
            grain.colour = {r.monotone(grain.colour.x, half_round), r.monotone(grain.colour.y, half_round),
                            r.monotone(grain.colour.z, half_round)};
        grain.colour = r.note(site::colour, grain.colour);
        return grain;
    }
};

} // namespace lockstep::dust
