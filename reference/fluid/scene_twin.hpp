#pragma once
#include <memory>

#include "reference/fluid/sites.hpp"
#include "reference/model/fluid/host.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"
#include "reference/system/seen_triangles.hpp"

namespace lockstep::fluid {

/// Of a vector its four numbers.
template <class R> ItemWords<R> words_of(const typename R::Vec4& v) {
    ItemWords<R> words;
    for (const auto& part : {v.x, v.y, v.z, v.w})
        words.add(part);
    return words;
}

/// The images that drawing the obstacles makes.
enum class Drawn { colour, depth };

/// Obstacles with a check of a metre on them, before the sky. Twin of shaders/fluid/scene_pass.*.
struct SceneTwin {
    HostPtr host;
    Drawn image;
    std::shared_ptr<const LatestTriangles> triangles; ///< one for both images
    std::shared_ptr<const TriangleView> view = {};
    std::shared_ptr<const SeenTriangles> seen = {}; ///< for readings of many lanes

    [[nodiscard]] SceneTwin at(const PassInput& in) const { return {host, image, triangles, triangles->of(in.before)}; }
    void look(const PassInput& in) const { static_cast<void>(view->seen(in.before)); }
    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        const Settings& s = host->settings();
        const DrawnTriangles<R> drawn(r, {in.before, field::corner_position, host->view_projection(), s.width, s.height,
                                          view->boxes(), seen.get()});
        const auto hit = drawn.nearest(pixel_at(s.width, item));
        if (image == Drawn::depth) {
            ItemWords<R> words;
            words.add(r.note(site::scene_depth, hit ? r.note(site::surface_depth, hit->depth) : Real(1.0F)));
            return words;
        }
        typename R::Vec3 colour = r.uniform(site::sky_colour, glm::vec3(scene_sky[0], scene_sky[1], scene_sky[2]));
        if (hit)
            colour = checked(r, drawn.position(*hit));
        return words_of<R>(r.note(site::scene, typename R::Vec4{colour.x, colour.y, colour.z, Real(1.0F)}));
    }

  private:
    template <class R> static typename R::Vec3 checked(R& r, const typename R::Vec3& p) {
        using Real = typename R::Real;
        const Real tile = r.note(site::tile, (r.floor(p.x) + r.floor(p.y)) + r.floor(p.z));
        const Real odd = tile - Real(2.0F) * r.floor(tile * Real(0.5F));
        const Real t = r.note(site::check, Real(0.5F) * odd);
        const Real grey = Real(0.8F) * (Real(1.0F) - t) + Real(0.9F) * t;
        return {grey, grey, grey};
    }
};

} // namespace lockstep::fluid
