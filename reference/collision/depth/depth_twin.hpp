#pragma once
#include <optional>

#include "reference/collision/collision_twin.hpp"

namespace lockstep {

namespace site {
inline constexpr Site in_front{"in front of the camera", "trace_in_front"};
inline constexpr Site surface_texel{"surface's texel"};
inline constexpr Site shows_surface{"shows a surface", "trace_neighbour_reached"};
inline constexpr Site stored_depth{"stored depth"};
inline constexpr Site texel_centre{"texel's centre"};
inline constexpr Site texel_ndc{"texel's ndc", "trace_neighbour_ndc"};
inline constexpr Site inverse{"u_InverseProjView"};
inline constexpr Site unprojected{"unprojected", "trace_neighbour_unprojected"};
inline constexpr Site surface{"surface position", "trace_neighbour_surface"};
inline constexpr Site surface_distance{"surface's distance", "trace_neighbour_w"};
inline constexpr Site depth_behind{"depth behind", "trace_behind"};
inline constexpr Site behind_surface{"behind the surface", "trace_is_behind", "world units"};
inline constexpr Site thickness{"u_SurfaceThickness"};
inline constexpr Site within_thickness{"within the thickness", "trace_is_within", "world units"};
inline constexpr Site right_step{"step to the right texel"};
inline constexpr Site upper_step{"step to the upper texel"};
inline constexpr Site to_right{"to the right", "trace_to_right"};
inline constexpr Site to_upper{"to the upper", "trace_to_upper"};
inline constexpr Site normal{"surface's normal", "trace_normal"};
} // namespace site

/// One particle's step against the obstacles' depth, over a reading `R`: what a texel shows is brought back to the
/// world by the inverse matrix, its normal comes from the texels to the right and above, and a particle that lies
/// behind by less than the thickness answers as the listing does, the normal being its way out. Both matrices are those
/// that the depth was drawn with. Twin of shaders/collision/depth_pass.comp.
template <class R> class DepthTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    using Vec4 = typename R::Vec4;
    using Texel = typename R::IVec2;

  public:
    struct Hit {
        Texel texel;
        Vec3 normal; ///< of no particular length, out of the surface
        auto fields() { return std::tie(texel, normal); }
        auto fields() const { return std::tie(texel, normal); }
    };
    struct State : ParticleTwinState<R> {
        std::optional<Hit> hit = {};
    };

    DepthTwin(R& reading, const CollisionImage& depth, const FrameParams& params)
        : r(reading), depth_(depth), params_(params), image_(reading, params), particle_(reading, params) {}

    [[nodiscard]] State operator()(const ParticleState& before) const {
        const ParticleTwinState<R> a = particle_.read(before);
        if (r.decide(site::searches, a.collide_time < 0.0F))
            if (const auto hit = surface_hit(a.position))
                return {particle_.collide(a, hit->normal), hit};
        return {particle_.integrate(a)};
    }

    /// The surface that `own` lies closely behind.
    [[nodiscard]] std::optional<Hit> surface_hit(const Vec3& own) const {
        const auto& matrix = r.uniform(site::proj_view, params_.earlier_proj_view);
        const Vec4 clip = r.note(site::clip, r.transform(site::clip, matrix, own));
        if (!r.decide(site::in_front, clip.w > 0.0F))
            return {};
        const auto texel = image_.base_texel(image_.image_position(clip));
        if (!texel)
            return {};
        const auto here = surface(*texel);
        if (!here)
            return {};
        const Real deeper = r.note(site::depth_behind, clip.w - here->distance);
        const Real thickness = r.uniform(site::thickness, params_.constants.surface_thickness);
        if (!r.decide(site::behind_surface, deeper > 0.0F) || !r.decide(site::within_thickness, deeper < thickness))
            return {};
        const auto right = surface(*texel + r.uniform(site::right_step, glm::ivec2(1, 0)));
        const auto upper = surface(*texel + r.uniform(site::upper_step, glm::ivec2(0, 1)));
        if (!right || !upper)
            return {};
        const Vec3 x = r.note(site::to_right, right->position - here->position);
        const Vec3 y = r.note(site::to_upper, upper->position - here->position);
        const Vec3 normal =
            r.note(site::normal, Vec3{x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x});
        return Hit{*texel, normal};
    }

  private:
    struct Surface {
        Vec3 position;
        Real distance; ///< clip w
    };

    /// What a texel shows; nothing outside the image and where no obstacle is drawn.
    [[nodiscard]] std::optional<Surface> surface(const Texel& texel) const {
        const Texel size = image_.size();
        const glm::vec4* stored = r.fetch(site::surface_texel, depth_, size, texel);
        if (stored == nullptr || !r.decide(site::shows_surface, stored->a != 0.0F))
            return {};
        const Real depth = r.read(site::stored_depth, stored->x);
        const auto ndc = [&](const auto& at, const auto& texels) {
            return r.divide(site::texel_ndc, r.note(site::texel_centre, r.real(at) + 0.5F), r.real(texels)) * 2.0F -
                   1.0F;
        };
        const Vec3 seen =
            r.note(site::texel_ndc, Vec3{ndc(texel.x, size.x), ndc(texel.y, size.y), depth * 2.0F - 1.0F});
        const auto& inverse = r.uniform(site::inverse, params_.earlier_inverse);
        const Vec4 p = r.note(site::unprojected, r.transform(site::unprojected, inverse, seen));
        const Vec3 position =
            r.note(site::surface, Vec3{r.divide(site::surface, p.x, p.w), r.divide(site::surface, p.y, p.w),
                                       r.divide(site::surface, p.z, p.w)});
        return Surface{position, r.note(site::surface_distance, r.divide(site::surface_distance, Real(1.0F), p.w))};
    }

    R& r;
    const CollisionImage& depth_;
    const FrameParams& params_;
    BaseTexelTwin<R> image_;
    ParticleTwin<R> particle_;
};

} // namespace lockstep
