#pragma once
#include <glm/mat4x4.hpp>

#include "reference/lifecycle/appearance.hpp"
#include "reference/lifecycle/forces.hpp"
#include "reference/lifecycle/lengths.hpp"

namespace lockstep::lifecycle {

/// Both edges of the ribbon at each point, facing the camera, and u at both ends of the segment that begins there. View
/// space, the eye at 0. Twin of shaders/lifecycle/ribbon.comp.
struct RibbonPointsTwin {
    HostPtr host;
    const HostEmitter* of;
    glm::mat4 view;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.has(item) || !r.decide(site::is_point, emitter.slot(item) < emitter.alive())) {
            ItemWords<R> words;
            const RawWords raw = raw_words(in.before, point_buffer, item);
            for (std::size_t w = 0; w < 8; ++w)
                words.add(Real(std::bit_cast<float>(raw[w])));
            return words;
        }
        const std::uint32_t i = emitter.slot(item), n = emitter.alive();
        const auto seen = [&](std::uint32_t k) {
            const auto p = r.transform(site::view, r.uniform(site::view, view),
                                       Particle<R>(r, *host, emitter.words_of(emitter.point_slot(k))).position());
            return Vec3{p.x, p.y, p.z};
        };
        const Vec3 p = r.note(site::seen_point, seen(i));
        const Vec3 before = i > 0 ? r.note(site::segment_before, p - seen(i - 1)) : Vec3{};
        const Vec3 after = i + 1 < n ? r.note(site::segment_after, seen(i + 1) - p) : Vec3{};
        Vec3 tangent = r.note(site::tangent, unit(r, before) + unit(r, after));
        if (!has_length(r, tangent))
            tangent = has_length(r, before) ? before : after;
        Vec3 side = unit(r, cross_of(tangent, -p));
        if (!has_length(r, side))
            side = {Real(1.0F), Real(0.0F), Real(0.0F)};
        side = r.note(site::side_of_ribbon, side);
        Real reach =
            r.note(site::half_width, size_of(r, Particle<R>(r, *host, emitter.words_of(emitter.point_slot(i)))) * 0.5F);
        if (host->switches().ribbon_joint == RibbonJoint::mitre) {
            const Vec3 along = has_length(r, after) ? after : before;
            const Real c = r.note(site::mitre, r.dot(site::mitre, side, unit(r, cross_of(along, -p))));
            if (r.decide(site::is_mitred, c >= 0.25F))
                reach = reach * r.divide(site::mitre, Real(1.0F), c);
        }
        const Vec3 edge = side * reach;
        ItemWords<R> words;
        for (const Vec3& v : {r.note(site::left, p + edge), r.note(site::right, p - edge)})
            for (const Real& x : {v.x, v.y, v.z})
                words.add(x);
        const Real scale = r.uniform(site::uv_scale, of->settings().uv_scale);
        Real first(0.0F), last(1.0F);
        if (of->settings().uv != Emitter::Uv::segment) {
            first = u(r, in, emitter, i, n);
            last = i + 1 < n ? u(r, in, emitter, i + 1, n) : first;
        }
        words.add(r.note(site::first_u, first * scale));
        words.add(r.note(site::last_u, last * scale));
        return words;
    }

  private:
    template <class R> static bool has_length(R& r, const typename R::Vec3& v) {
        return r.decide(site::has_length, r.dot(site::has_length, v, v) > 0.0F);
    }
    /// 0 where the squared length is 0, infinite or NaN.
    template <class R> static typename R::Vec3 unit(R& r, const typename R::Vec3& v) {
        const auto squared = r.dot(site::unit, v, v);
        if (!r.decide(site::has_unit, squared > 0.0F && squared < HUGE_VALF))
            return {};
        const auto length = r.sqrt(site::unit, squared);
        return {r.divide(site::unit, v.x, length), r.divide(site::unit, v.y, length),
                r.divide(site::unit, v.z, length)};
    }
    template <class R> typename R::Real u(R& r, const PassInput& in, const EmitterTwin<R>& emitter, std::uint32_t i,
                                          std::uint32_t n) const {
        using Real = typename R::Real;
        const Switches& s = host->switches();
        if (of->settings().uv == Emitter::Uv::stretched) {
            if (s.stretched_divisor == StretchedDivisor::last_index)
                return r.divide(site::stretched, R::real(i), R::real(n - 1));
            return i == 0 ? Real(0.0F) : r.divide(site::stretched, R::real(i + 1), R::real(n));
        }
        if (s.distance_sum == DistanceSum::float_blocks)
            return Particle<R>(r, *host, emitter.words_of(emitter.point_slot(i))).from_start();
        std::uint32_t sum = in.before.word({length_buffer, 0}, of->base + i);
        if (s.uv_anchor == UvAnchor::fixed)
            sum +=
                noted(r, site::distance_origin, in.before.word({counter_buffer, counter::distance_origin}, of->number));
        return Lengths<R>(r, s).distance({{}, sum});
    }
};

} // namespace lockstep::lifecycle
