#pragma once
#include <utility>

#include "reference/fluid/depth_map.hpp"
#include "reference/fluid/scene_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// Normals from differences of depths. Twin of shaders/fluid/normal_pass.comp.
struct NormalTwin {
    HostPtr host;

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const auto p = pixel_at(host->settings().width, item);
        const DepthMap<R> map(r, *host, in.before, last_depth(*host));
        const Real stored = map.at(site::centre_depth, p.x, p.y);
        if (map.is_empty(site::centre_empty, stored))
            return words_of<R>(r.note(site::normal, typename R::Vec4{}));
        const Vec3 here = point_at(r, *host, p.x, p.y, map.code().unprojected(stored));
        const auto side = [&](int dx, int dy) { return neighbour(r, map, p.x + dx, p.y + dy); };
        const auto right = side(1, 0), left = side(-1, 0), up = side(0, 1), down = side(0, -1);
        Vec3 n = r.note(site::facing, Vec3{Real(0.0F), Real(0.0F), Real(1.0F)});
        if ((right.exists || left.exists) && (up.exists || down.exists)) {
            // The published code takes the left on equal steps, and the upper.
            const auto to_right =
                picks(right.exists, left.exists, [&] { return takes_right(r, here, right.point, left.point); });
            const auto upwards =
                picks(up.exists, down.exists, [&] { return takes_upper(r, here, up.point, down.point); });
            const auto step_from = [&](At at, const Vec3& before) { return r.note(at, here - before); };
            const auto step = [&](const auto& on, const Vec3& after, At at, const Vec3& before) {
                if constexpr (HasLanes<R>)
                    return choose(on, after - here, here - before);
                else
                    return on ? after - here : step_from(at, before);
            };
            const Vec3 dx = r.note(site::step_x, step(to_right, right.point, site::step_left, left.point)),
                       dy = r.note(site::step_y, step(upwards, up.point, site::step_up, down.point));
            const Vec3 cross = r.note(
                site::cross, Vec3{dx.y * dy.z - dx.z * dy.y, dx.z * dy.x - dx.x * dy.z, dx.x * dy.y - dx.y * dy.x});
            if (!r.decide(site::has_no_length, r.dot(site::cross, cross, cross) == Real(0.0F)))
                n = r.normalize(site::normal, cross);
        }
        return words_of<R>(r.note(site::normal, typename R::Vec4{n.x, n.y, n.z, Real(1.0F)}));
    }

  private:
    template <class Vec3> struct SideOf {
        bool exists;
        Vec3 point;
    };
    template <class R>
    SideOf<typename R::Vec3> neighbour(R& r, const DepthMap<R>& map, const IndexOf<R>& x, int y) const {
        const bool facing = r.setting(site::faces_at_edges, host->switches().edge_normal == EdgeNormal::facing);
        if (facing && !agreed(r, site::neighbour_empty, map.has(x, y)))
            return {false, {}};
        const auto stored = map.at(site::sample, x, y);
        if (facing && map.is_empty(site::neighbour_empty, stored))
            return {false, {}};
        return {true, point_at(r, *host, x, y, map.code().unprojected(stored))};
    }
    /// The side that is there; of two that of `between`.
    template <class Between> static auto picks(bool first, bool second, const Between& between) {
        using Pick = decltype(between());
        return !first ? Pick(no_side<Pick>()) : !second ? Pick(!no_side<Pick>()) : between();
    }
    template <class Pick> static Pick no_side() { return {}; }
    template <class R, class Vec3> auto takes_right(R& r, const Vec3& here, const Vec3& right, const Vec3& left) const {
        if (host->switches().difference_pick == DifferencePick::nearer)
            return decided(r, site::right_side, right.z > left.z);
        return decided(r, site::right_side, r.abs(right.z - here.z) < r.abs(here.z - left.z));
    }
    template <class R, class Vec3> auto takes_upper(R& r, const Vec3& here, const Vec3& up, const Vec3& down) const {
        if (host->switches().difference_pick == DifferencePick::nearer)
            return decided(r, site::upper_side, up.z > down.z);
        return !decided(r, site::upper_side, r.abs(here.z - down.z) < r.abs(up.z - here.z));
    }
};

} // namespace lockstep::fluid
