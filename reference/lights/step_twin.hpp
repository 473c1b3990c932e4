#pragma once
#include <array>

#include "reference/lights/sites.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::lights {

/// Whether all that a light is made of is a number: others stay as they are, and light nothing.
inline bool is_finite_light(const SystemView& state, std::size_t i) {
    for (std::uint8_t f = 0; f < 6; ++f)
        for (int c = 0; c < state[light_buffer].fields()[f].components; ++c)
            if (!std::isfinite(state.real({light_buffer, f}, i, c)))
                return false;
    return true;
}

/// A light's way in a frame, between the walls of the grid. Twin of shaders/lights/light_step_pass.comp.
struct StepTwin {
    HostPtr host;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        Vec3 p = in_before(r, in, site::before, field::light_position, item);
        Vec3 d = in_before(r, in, site::way, field::light_direction, item);
        if (is_finite_light(in.before, item) && r.setting(site::moves, host->switches().motion == Motion::bounce)) {
            const Real s = r.read(site::speed_before, in.before.real(field::speed, item));
            const Vec3 low = r.uniform(site::low, host->grid().origin), high = r.uniform(site::high, host->end());
            p = r.note(site::moved, p + r.note(site::step, d * s * r.uniform(site::tick, host->settings().tick)));
            bounce(r, p.x, d.x, low.x, high.x);
            bounce(r, p.y, d.y, low.y, high.y);
            bounce(r, p.z, d.z, low.z, high.z);
        }
        p = r.note(site::position, p);
        d = r.note(site::direction, d);
        ItemWords<R> words;
        add(words, p);
        words.add(in.before.word(field::range, item));
        add(words, d);
        words.add(in.before.word(field::speed, item));
        for (int c = 0; c < 3; ++c)
            words.add(in.before.word(field::light_colour, item, c));
        words.add(in.before.word(field::inv_range2, item));
        for (int c = 0; c < 4; ++c)
            words.add(in.before.word({light_buffer, 6}, item, c));
        return words;
    }

  private:
    template <class R>
    static typename R::Vec3 in_before(R& r, const PassInput& in, At at, FieldId field, std::size_t item) {
        return r.read(at, in.before.vec3(field, item));
    }
    template <class R> static void add(ItemWords<R>& words, const typename R::Vec3& v) {
        words.add(v.x);
        words.add(v.y);
        words.add(v.z);
    }
    template <class R, class Real> static void bounce(R& r, Real& p, Real& d, const Real& to_low, const Real& to_high) {
        const Real low = r.note(site::wall_low, to_low), high = r.note(site::wall_high, to_high);
        if (r.decide(site::below, p < low)) {
            p = r.note(site::mirrored_low, low + (low - p));
            d = r.note(site::turned, -d);
        } else if (r.decide(site::above, p > high)) {
            p = r.note(site::mirrored_high, high - (p - high));
            d = r.note(site::turned, -d);
        }
        if (r.decide(site::still_below, p < low))
            p = low;
        else if (r.decide(site::still_above, p > high))
            p = high;
    }
};

} // namespace lockstep::lights
