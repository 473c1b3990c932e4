#pragma once
#include <algorithm>
#include <cstddef>

#include "reference/fluid/linear_fetch.hpp"
#include "reference/model/fluid/host.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/system/item_reads.hpp"

namespace lockstep::fluid {

/// The scene's colour at a place given in texels, texel (0, 0) from 0 to 1. Twin of fetched_scene in
/// shaders/fluid/fluid_shade_pass.comp.
template <class R> class RefractedScene {
    using Real = typename R::Real;
    using Vec2 = typename R::Vec2;
    using Vec3 = typename R::Vec3;
    using Index = IndexOf<R>;

  public:
    RefractedScene(R& r, const Host& host, const SystemView& state) : r_(r), host_(host), state_(state) {}

    [[nodiscard]] Vec3 at(const Vec2& place) const {
        switch (host_.switches().scene_fetch) {
        case SceneFetch::nearest:
            return texel(whole(r_.floor(place.x)), whole(r_.floor(place.y)));
        case SceneFetch::bilinear:
            return bilinear(place);
        case SceneFetch::linear:
            return {filtered(place, 0), filtered(place, 1), filtered(place, 2)};
        }
        return {};
    }

  private:
    [[nodiscard]] Index whole(const Real& x) const {
        return index_of<R>(r_.to_int(site::base, r_.note(site::base, x)));
    }
    [[nodiscard]] Vec3 texel(const Index& x, const Index& y) const {
        const Settings& s = host_.settings();
        return item_vec3(r_, site::scene_texel, state_, field::scene,
                         item_of(clamped(x, 0, s.width - 1), clamped(y, 0, s.height - 1), s.width));
    }
    struct Axis {
        Index base;
        Real f;
    };
    [[nodiscard]] Axis axis(const Real& at) const {
        const Real p = r_.setting(site::texels_have_middles, true) ? at - Real(0.5F) : at;
        const Index base = whole(r_.floor(p));
        return {base, r_.note(site::fraction, p - r_.real(base))};
    }
    [[nodiscard]] Vec3 bilinear(const Vec2& place) const {
        const Axis x = axis(place.x), y = axis(place.y);
        const auto mixed = [](const Vec3& a, const Vec3& b, const Real& f) { return a * (Real(1.0F) - f) + b * f; };
        const auto row = [&](int dy) { return mixed(texel(x.base, y.base + dy), texel(x.base + 1, y.base + dy), x.f); };
        return mixed(row(0), row(1), y.f);
    }
    [[nodiscard]] Real filtered(const Vec2& place, int c) const {
        const Settings& s = host_.settings();
        const auto along = [&](const Real& at, int size, At size_at) {
            return r_.divide(site::filtered, at, r_.uniform(size_at, static_cast<float>(size)));
        };
        const auto one = [this, c, &s](const Index& x, const Index& y) {
            return raw_real(state_, field::scene, item_of(x, y, s.width), c);
        };
        return linear_fetch(r_, site::filtered, host_.linear_filter(),
                            Vec2{along(place.x, s.width, site::width), along(place.y, s.height, site::height)},
                            Texels<decltype(one)>{s.width, s.height, one});
    }

    R& r_;
    const Host& host_;
    const SystemView& state_;
};

} // namespace lockstep::fluid
