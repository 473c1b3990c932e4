#pragma once
#include <optional>

#include "reference/dust/grain.hpp"
#include "reference/model/dust/host.hpp"

/// What the vacuum does to a grain in its cone. Twin of shaders/dust/cone.glsl.
namespace lockstep::dust {

template <class R> class ConeTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    ConeTwin(R& reading, const Host& host, const FrameValues& values)
        : r(reading), mouth_(r.uniform(site::controller_pos, values.controller_pos)),
          axis_(r.uniform(site::controller_forward, values.controller_forward)),
          threshold_(r.uniform(site::cleaner_threshold, values.threshold)),
          sqr_range_(r.uniform(site::cleaner_sqr_dist, values.sqr_range)),
          sqr_death_(r.uniform(site::cleaner_sqr_death, values.sqr_death_range)),
          sqr_force_(r.uniform(site::cleaner_sqr_force, values.sqr_force)), switches_(host.switches()) {}

    /// The force on a grain that the cone has; none on others.
    [[nodiscard]] std::optional<Vec3> force(const Vec3& position) const {
        const Vec3 way = r.note(site::to_mouth, mouth_ - position);
        const Real d2 = r.note(site::sqr_dist, squared(way));
        if (!r.decide(site::in_range, d2 < sqr_range_))
            return {};
        if (switches_.safe_direction == OffOn::on && !r.decide(site::no_direction, d2 > 0.0F))
            return {};
        const Vec3 n = r.note(site::to_mouth_unit, r.normalize(site::to_mouth_unit, way));
        const Real k = r.note(site::along, r.dot(site::along, axis_, -n));
        if (!r.decide(site::in_cone, k > threshold_))
            return {};
        return r.note(site::force,
                      (n * r.note(site::pull, r.divide(site::pull, sqr_force_, d2))) * r.note(site::force_along, k));
    }

    /// Whether a grain that was pulled is in the mouth, or out of the cone, at `next`.
    [[nodiscard]] bool kills(const Vec3& position, const Vec3& next) const {
        const Vec3 b = r.note(site::current_direction, r.normalize(site::current_direction, -(mouth_ - position)));
        const Vec3 away = r.note(site::mouth_to_forecast, next - mouth_);
        const Vec3 c = r.note(site::next_direction, r.normalize(site::next_direction, away));
        if (!r.decide(site::was_in_cone,
                      r.note(site::current_along, r.dot(site::current_along, axis_, b)) > threshold_))
            return false;
        const Real along = r.note(site::next_along, r.dot(site::next_along, axis_, c));
        const Real d2 = r.note(site::sqr_dist_next, squared(away));
        if (switches_.side_exit == SideExit::keep)
            return r.decide(site::behind, along < 0.0F) || r.decide(site::near_mouth, d2 < sqr_death_);
        return r.decide(site::left_cone, along < threshold_) || r.decide(site::near_mouth, d2 < sqr_death_);
    }

    [[nodiscard]] const Vec3& mouth() const { return mouth_; }
    [[nodiscard]] const Vec3& axis() const { return axis_; }
    [[nodiscard]] const Real& threshold() const { return threshold_; }
    [[nodiscard]] const Real& sqr_range() const { return sqr_range_; }
    [[nodiscard]] const Real& sqr_death() const { return sqr_death_; }
    [[nodiscard]] const Real& sqr_force() const { return sqr_force_; }

  private:
    R& r;
    Vec3 mouth_, axis_;
    Real threshold_, sqr_range_, sqr_death_, sqr_force_;
    const Switches& switches_;
};

} // namespace lockstep::dust
