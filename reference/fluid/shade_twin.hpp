#pragma once
#include "reference/fluid/scene_twin.hpp"
#include "reference/fluid/shading.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// Light on the surface, through it and mirrored by it. Twin of shaders/fluid/fluid_shade_pass.comp.
struct ShadeTwin {
    HostPtr host;

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const auto pixel = pixel_at(host->settings().width, item);
        const DepthMap<R> map(r, *host, in.before, last_depth(r, *host));
        const Real stored = map.at(site::centre_depth, pixel.x, pixel.y);
        Vec3 lit{};
        if (map.is_empty(site::centre_empty, stored))
            lit = item_vec3(r, site::background, in.before, field::scene, item);
        else if (!map.is_black(stored))
            lit = Shading<R>{r, *host, in.before}.at(pixel, item, map.code().unprojected(stored));
        lit = r.note(site::light_to_eye, lit);
        return words_of<R>(r.note(site::lit, typename R::Vec4{lit.x, lit.y, lit.z, Real(1.0F)}));
    }
};

} // namespace lockstep::fluid
