#pragma once
#include "reference/collision/billboard.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/numbers.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {

/// A fragment of a particle's billboard: the sphere of its radius where the square's pixel looks at it, seen without
/// perspective.
template <class A> struct SphereFragment {
    typename NumbersOf<A>::Bool inside; ///< of the disc; else it is dropped
    typename NumbersOf<A>::Vec3 normal;
    typename NumbersOf<A>::Real depth; ///< window, 0..1
};

/// `centre`: the particle's, view space. Twin of shaders/collision/render_pass.frag.
template <class A, class Sites>
SphereFragment<A> sphere_fragment(A fp, const Sites& sites, const typename NumbersOf<A>::Vec3& centre,
                                  const BillboardWindowOf<typename NumbersOf<A>::Vec2>& window, int x, int y,
                                  const FrameParams& params) {
    using Real = typename NumbersOf<A>::Real;
    const Real dx = fp.divide(Real(static_cast<float>(x) + sites.pixel_centre()) - window.centre.x, window.half.x);
    const Real dy = fp.divide(Real(static_cast<float>(y) + sites.pixel_centre()) - window.centre.y, window.half.y);
    const Real squared = dx * dx + dy * dy;
    const auto inside = sites.in_disc(squared <= 1.0F, squared);
    const Real rest = sites.under_root(Real(1.0F) - where(inside, squared, 1.0F));
    const Real root = sites.rooted(fp.sqrt(rest), rest);
    const typename NumbersOf<A>::Vec3 sphere{dx, dy, root};
    const float radius = params.constants.billboard_radius;
    const Real z = centre.z + sites.towards_camera(root, root * radius, radius);
    const auto clip = fp.transform(params.render_projection, {centre.x, centre.y, z});
    const Real ndc = fp.divide(clip.z, clip.w);
    return {inside, sites.sphere_normal(sphere), clamp_to(sites.sprite_depth(ndc, ndc * 0.5F + 0.5F), 1.0F)};
}

} // namespace lockstep
