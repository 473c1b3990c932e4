#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "reference/fluid/depth_map.hpp"
#include "reference/fluid/scene_twin.hpp"
#include "reference/fluid/unit_normal.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// Normals from differences of depths. Twin of shaders/fluid/normal_pass.comp.
struct NormalTwin {
    HostPtr host;
    std::shared_ptr<const FilteredImage> image = {};

    [[nodiscard]] NormalTwin at(const PassInput& /*in*/) const {
        return {host, filtered_image(*host, last_depth(*host), 1)};
    }

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const auto p = pixel_at(host->settings().width, item);
        const DepthMap<R> map(r, *host, in.before, last_depth(r, *host), image.get());
        const Real stored = map.at(site::centre_depth, p.x, p.y);
        if (map.is_empty(site::centre_empty, stored))
            return words_of<R>(r.note(site::normal, typename R::Vec4{}));
        const Vec3 here = point_at(r, *host, p.x, p.y, map.code().unprojected(stored));
        const auto side = [&](int dx, int dy) { return neighbour(r, map, {p.x, p.y}, {dx, dy}); };
        const auto way = [&](At is_right, int right_way) { return r.setting(is_right, true) ? right_way : -right_way; };
        const auto right = side(way(site::right_is_right, 1), 0), left = side(way(site::left_is_left, -1), 0),
                   up = side(0, way(site::upper_is_above, 1)), down = side(0, way(site::lower_is_below, -1));
        Vec3 n = r.note(site::facing, Vec3{Real(0.0F), Real(0.0F), Real(1.0F)});
        if ((right.exists || left.exists) && (up.exists || down.exists)) {
            // The published code takes the left on equal steps, and the upper.
            const auto to_right =
                picks(right.exists, left.exists, [&] { return takes_right(r, here, right.point, left.point); });
            const auto upwards =
                picks(up.exists, down.exists, [&] { return takes_upper(r, here, up.point, down.point); });
            struct Step {
                At on, back;
            };
            const auto step = [&](const auto& on, const auto& after, const Step& at, const auto& before) {
                if constexpr (HasLanes<R>)
                    return choose(on, after.point - here, here - before.point);
                else if (after.exists && before.exists && !r.setting(site::one_sided, true))
                    return after.point - before.point;
                else
                    return on ? r.note(at.on, after.point - here) : r.note(at.back, here - before.point);
            };
            const Vec3 dx = r.note(site::step_x, step(to_right, right, {site::step_right, site::step_left}, left)),
                       dy = r.note(site::step_y, step(upwards, up, {site::step_above, site::step_up}, down));
            const Vec3 cross = r.note(
                site::cross, Vec3{dx.y * dy.z - dx.z * dy.y, dx.z * dy.x - dx.x * dy.z, dx.x * dy.y - dx.y * dy.x});
            if constexpr (requires(const Real& x) { x.legal(); })
                if (const auto legal = by_rays(p, cross, here, {to_right ? 1 : -1, to_right ? right.point : left.point},
                                               {upwards ? 1 : -1, upwards ? up.point : down.point})) {
                    const auto within = [&](int c) {
                        return unspecified_within(r, site::normal, cross.x, (*legal)[static_cast<std::size_t>(c)]);
                    };
                    return words_of<R>(
                        r.note(site::normal, typename R::Vec4{within(0), within(1), within(2), Real(1.0F)}));
                }
            if (!r.decide(site::has_no_length, r.dot(site::cross, cross, cross) == Real(0.0F)))
                n = r.normalize(site::normal, cross);
        }
        return words_of<R>(r.note(site::normal, typename R::Vec4{n.x, n.y, n.z, Real(1.0F)}));
    }

  private:
    /// A neighbour: 1 to the right or above, else -1.
    template <class Vec3> struct Taken {
        int offset;
        Vec3 point;
    };
    /// The normal where the cross product's length may be lost, and no points of these rays make it 0.
    template <class Vec3>
    [[nodiscard]] std::optional<std::array<Interval, 3>> by_rays(const Pixel& p, const Vec3& cross, const Vec3& here,
                                                                 const Taken<Vec3>& beside,
                                                                 const Taken<Vec3>& above) const {
        using item_twin::set_of;
        if (!may_lack_length({set_of(cross.x), set_of(cross.y), set_of(cross.z)}))
            return {};
        const Settings& s = host->settings();
        const auto ray = [&](int x, int y) {
            return glm::dvec3((2.0 * x + 1.0 - s.width) / s.width * host->slope().x,
                              (2.0 * y + 1.0 - s.height) / s.height * host->slope().y, -1.0);
        };
        const auto forward = [](const Vec3& point) { return interval::negate(set_of(point.z)); };
        auto legal = unit_normal({{forward(here), forward(beside.point), forward(above.point)},
                                  {ray(p.x, p.y), ray(p.x + beside.offset, p.y), ray(p.x, p.y + above.offset)}});
        if (legal && beside.offset != above.offset)
            for (Interval& set : *legal)
                set = interval::negate(set);
        return legal;
    }
    template <class Vec3> struct SideOf {
        bool exists;
        Vec3 point;
    };
    template <class Index> struct Place {
        Index x;
        int y;
    };
    template <class R> SideOf<typename R::Vec3> neighbour(R& r, const DepthMap<R>& map, const Place<IndexOf<R>>& pixel,
                                                          const Place<int>& offset) const {
        const IndexOf<R> x = pixel.x + offset.x;
        const int y = pixel.y + offset.y;
        const bool facing = r.setting(site::faces_at_edges, host->switches().edge_normal == EdgeNormal::facing);
        if (facing && !agreed(r, site::neighbour_empty, map.has(x, y)))
            return {false, {}};
        const auto stored = map.at(site::sample, x, y);
        if (facing && map.is_empty(site::neighbour_empty, stored))
            return {false, {}};
        const auto z = map.code().unprojected(stored);
        if (!r.setting(site::on_own_ray, true))
            return {true, point_at(r, *host, pixel.x, pixel.y, z)};
        return {true, point_at(r, *host, x, y, z)};
    }
    /// The side that is there; of two that of `between`.
    template <class Between> static auto picks(bool first, bool second, const Between& between) {
        using Pick = decltype(between());
        return !first ? Pick(no_side<Pick>()) : !second ? Pick(!no_side<Pick>()) : between();
    }
    template <class Pick> static Pick no_side() { return {}; }
    template <class R, class Vec3> auto takes_right(R& r, const Vec3& here, const Vec3& right, const Vec3& left) const {
        const bool nearer = r.setting(site::picks_nearer, true);
        if (host->switches().difference_pick == DifferencePick::nearer)
            return decided(r, site::right_side, nearer ? right.z > left.z : right.z < left.z);
        const auto ahead = r.abs(right.z - here.z), behind = r.abs(here.z - left.z);
        return decided(r, site::right_side, nearer ? ahead < behind : behind < ahead);
    }
    template <class R, class Vec3> auto takes_upper(R& r, const Vec3& here, const Vec3& up, const Vec3& down) const {
        const bool nearer = r.setting(site::picks_nearer, true);
        if (host->switches().difference_pick == DifferencePick::nearer)
            return decided(r, site::upper_side, nearer ? up.z > down.z : up.z < down.z);
        const auto behind = r.abs(here.z - down.z), ahead = r.abs(up.z - here.z);
        return decided(r, site::upper_side, nearer ? !(behind < ahead) : !(ahead < behind));
    }
};

} // namespace lockstep::fluid
