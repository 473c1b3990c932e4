#pragma once
#include "reference/fluid/sites.hpp"
#include "reference/model/fluid/host.hpp"
#include "reference/readings/decided.hpp"

namespace lockstep::fluid {

/// What the depth images hold of a z in view space, and back. Twin of shaders/fluid/depth.glsl.
template <class R> class DepthCode {
    using Real = typename R::Real;

  public:
    DepthCode(R& r, const Host& host) : r_(r), host_(host) {}

    [[nodiscard]] float empty() const { return value() == DepthValue::view ? 0.0F : 1.0F; }
    [[nodiscard]] bool is_metric() const { return value() == DepthValue::view; }

    [[nodiscard]] Real ndc(const Real& z) const {
        const auto of = coefficients();
        const Real clip_z = r_.note(site::clip_z, of.x * z + of.y);
        return r_.note(site::ndc, r_.divide(site::ndc, clip_z, -z));
    }
    [[nodiscard]] Real window(const Real& z) const { return r_.note(site::window, ndc(z) * Real(0.5F) + Real(0.5F)); }
    [[nodiscard]] Real stored(const Real& z) const {
        if (is_metric())
            return z;
        const Real v = value() == DepthValue::ndc ? ndc(z) : window(z);
        return coded(r_.note(site::clamped, r_.min(Real(1.0F), r_.max(Real(0.0F), v))));
    }
    /// As depth_format rounds numbers from 0 to 1.
    [[nodiscard]] Real coded(const Real& v) const {
        if (!r_.setting(site::has_codes, host_.switches().depth_format == DepthFormat::d24))
            return v;
        const Real codes = r_.uniform(site::codes, depth_codes);
        return r_.divide(site::depth_code,
                         r_.note(site::depth_code, r_.floor(v * codes + r_.uniform(site::half_code, 0.5F))), codes);
    }
    /// What the depth test compares: of equal ones the stored depths are equal, so no order of spheres shows.
    [[nodiscard]] Real tested(const Real& z, const Real& stored) const {
        return r_.note(site::tested, is_metric() ? -z * r_.uniform(site::depth_scale, host_.depth_scale()) : stored);
    }
    [[nodiscard]] Real decoded(const Real& stored) const {
        if (is_metric() || !r_.setting(site::decodes, true))
            return stored;
        const bool is_window = value() == DepthValue::window && !r_.setting(site::window_is_ndc, false);
        return r_.note(site::decoded, of_ndc(is_window ? stored * Real(2.0F) - Real(1.0F) : stored));
    }
    /// As `unproject` takes what is stored.
    [[nodiscard]] Real unprojected(const Real& stored) const {
        const bool as_ndc = host_.switches().unproject == Unproject::as_ndc;
        return r_.note(site::unprojected,
                       !is_metric() && r_.setting(site::reads_ndc, as_ndc) ? of_ndc(stored) : decoded(stored));
    }

  private:
    [[nodiscard]] DepthValue value() const { return host_.switches().depth_value; }
    [[nodiscard]] typename R::Vec2 coefficients() const {
        const glm::vec2 of = host_.depth_coefficients();
        return r_.note(site::depth_coefficients, typename R::Vec2{Real(of.x), Real(of.y)});
    }
    [[nodiscard]] Real of_ndc(const Real& ndc) const {
        const auto of = coefficients();
        return r_.divide(site::decoded, -of.y, ndc + of.x);
    }

    R& r_;
    const Host& host_;
};

/// The slope of the ray through a pixel's centre.
template <class R> typename R::Vec2 pixel_slope(R& r, const Host& host, const IndexOf<R>& x, int y) {
    const Settings& s = host.settings();
    const int centre = r.setting(site::ray_of_centre, true) ? 1 : 0;
    const auto along = [&](At at, At size_at, At unit_at, const auto& i, int size, float unit) {
        const auto place = r.divide(at, r.real(2 * i + centre - size), r.uniform(size_at, static_cast<float>(size)));
        return r.note(at, place * r.uniform(unit_at, unit));
    };
    return {along(site::slope_x, site::width, site::unit_slope_x, x, s.width, host.slope().x),
            along(site::slope_y, site::height, site::unit_slope_y, y, s.height, host.slope().y)};
}

/// The point at depth z of that ray, in view space.
template <class R>
typename R::Vec3 point_at(R& r, const Host& host, const IndexOf<R>& x, int y, const typename R::Real& z) {
    const auto slope = pixel_slope(r, host, x, y);
    const auto forward = -z;
    return r.note(site::point, typename R::Vec3{forward * slope.x, forward * slope.y, z});
}

} // namespace lockstep::fluid
