#pragma once
#include <type_traits>

#include "reference/fluid/depth_map.hpp"

namespace lockstep::fluid {

/// A step of curvature flow (van der Laan, Green and Sainz, "Screen Space Fluid Rendering with Curvature Flow", 2009)
/// at a pixel, of depths in view space. Twin of shaders/fluid/curvature_flow.glsl.
template <class R> class CurvatureFlow {
    using Real = typename R::Real;
    using Index = IndexOf<R>;

  public:
    CurvatureFlow(R& r, const Host& host, const DepthMap<R>& map) : r_(r), host_(host), map_(map) {}

    [[nodiscard]] Real at(const Index& x, int y, const Real& z) const {
        const auto right = near(x + 1, y, z), left = near(x - 1, y, z), up = near(x, y + 1, z),
                   down = near(x, y - 1, z);
        const Real half(0.5F), zero(0.0F), twice = r_.setting(site::takes_middle_twice, true) ? z + z : z;
        const bool any = !needs_both_sides();
        const auto has_x = any || (right.counts && left.counts), has_y = any || (up.counts && down.counts);
        const auto slope = [&](const Real& after, const Real& before) {
            return r_.setting(site::slopes_of_two, true) ? (after - before) * half : after - z;
        };
        const Real zx = r_.note(site::zx, choose(has_x, slope(right.z, left.z), zero)),
                   zy = r_.note(site::zy, choose(has_y, slope(up.z, down.z), zero)),
                   zxx = r_.note(site::zxx, choose(has_x, (right.z + left.z) - twice, zero)),
                   zyy = r_.note(site::zyy, choose(has_y, (up.z + down.z) - twice, zero)),
                   zxy = r_.note(site::zxy, mixed(x, y, z));

        const Real cx = r_.uniform(site::flow_scale_x, host_.flow_scale().x),
                   cy = r_.uniform(site::flow_scale_y, host_.flow_scale().y);
        const Real cx2 = cx * cx, cy2 = cy * cy, c = cx2 * cy2;
        const Real e0 = r_.note(site::e0, (cy2 * (zx * zx) + cx2 * (zy * zy)) + c * (z * z));
        const auto slope_of = [&](At at, const Real& along_x, const Real& along_y, const Real& along_z) {
            return r_.note(at, Real(2.0F) * ((cy2 * (zx * along_x) + cx2 * (zy * along_y)) + c * (z * along_z)));
        };
        const Real fx = slope_of(site::fx, zxx, zxy, zx), fy = slope_of(site::fy, zxy, zyy, zy);
        const Real ex = r_.note(site::ex, (zx * fx) * half - zxx * e0),
                   ey = r_.note(site::ey, (zy * fy) * half - zyy * e0);
        const Real h = r_.note(site::curvature, r_.divide(site::curvature, cy * ex + cx * ey,
                                                          (Real(2.0F) * e0) * r_.sqrt(site::e0_root, e0)));
        return z - h * r_.uniform(site::flow_step, host_.settings().flow_step);
    }

  private:
    [[nodiscard]] bool needs_both_sides() const { return r_.setting(site::needs_both_sides, true); }
    template <class Counts> struct Neighbour {
        Counts counts;
        Real z;
    };
    [[nodiscard]] auto near(const Index& x, int y, const Real& z) const {
        const auto has = map_.has(x, y);
        using Found = Neighbour<std::remove_cvref_t<decltype(has)>>;
        if (nowhere(has))
            return Found{has, z};
        const Real stored = map_.at(site::sample, x, y);
        const auto nothing = map_.has_nothing(site::empty, stored);
        if (everywhere(nothing))
            return Found{!nothing, z};
        const Real found = map_.code().decoded(stored);
        const Real reach = r_.uniform(site::flow_reach, host_.flow_reach());
        const Real step = r_.setting(site::reach_is_two_way, true) ? r_.abs(found - z) : found - z;
        return Found{has && !nothing && decided(r_, site::within_reach, step <= reach), found};
    }
    [[nodiscard]] Real mixed(const Index& x, int y, const Real& z) const {
        const auto upper_right = near(x + 1, y + 1, z), upper_left = near(x - 1, y + 1, z),
                   lower_right = near(x + 1, y - 1, z), lower_left = near(x - 1, y - 1, z);
        const auto all =
            !needs_both_sides() || (upper_right.counts && upper_left.counts && lower_right.counts && lower_left.counts);
        if (nowhere(all))
            return Real(0.0F);
        return choose(all, ((upper_right.z - upper_left.z) - (lower_right.z - lower_left.z)) * Real(0.25F), Real(0.0F));
    }

    R& r_;
    const Host& host_;
    const DepthMap<R>& map_;
};

} // namespace lockstep::fluid
