#pragma once
#include <algorithm>
#include <cstddef>

#include "reference/fluid/linear_fetch.hpp"
#include "reference/model/fluid/host.hpp"
#include "reference/model/fluid/schema.hpp"

namespace lockstep::fluid {

/// The scene's colour at a place given in texels, texel (0, 0) from 0 to 1. Twin of shaders/fluid/scene_fetch.glsl.
template <class R> class RefractedScene {
    using Real = typename R::Real;
    using Vec2 = typename R::Vec2;
    using Vec3 = typename R::Vec3;

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
    [[nodiscard]] int whole(const Real& x) const {
        return static_cast<int>(r_.to_int(site::base, r_.note(site::base, x)));
    }
    [[nodiscard]] float raw(int x, int y, int c) const {
        return state_.real(field::scene,
                           static_cast<std::size_t>(y) * static_cast<std::size_t>(host_.settings().width) +
                               static_cast<std::size_t>(x),
                           c);
    }
    [[nodiscard]] Vec3 texel(int x, int y) const {
        const int tx = std::clamp(x, 0, host_.settings().width - 1), ty = std::clamp(y, 0, host_.settings().height - 1);
        return r_.read(site::scene_texel, glm::vec3(raw(tx, ty, 0), raw(tx, ty, 1), raw(tx, ty, 2)));
    }
    struct Axis {
        int base;
        Real f;
    };
    [[nodiscard]] Axis axis(const Real& at) const {
        const Real p = at - Real(0.5F);
        const int base = whole(r_.floor(p));
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
            const Real extent = r_.uniform(size_at, static_cast<float>(size));
            return r_.divide(site::filtered, at, extent) * extent;
        };
        const auto one = [this, c](int x, int y) { return raw(x, y, c); };
        return linear_fetch(r_, site::filtered,
                            Vec2{along(place.x, s.width, site::width), along(place.y, s.height, site::height)},
                            Texels<decltype(one)>{s.width, s.height, one});
    }

    R& r_;
    const Host& host_;
    const SystemView& state_;
};

} // namespace lockstep::fluid
