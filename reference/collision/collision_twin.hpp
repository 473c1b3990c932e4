#pragma once
#include <optional>

#include "reference/collision/particle_twin.hpp"
#include "reference/model/image.hpp"
#include "reference/readings/values.hpp"

namespace lockstep {

/// Where clip space lies on the image (thesis, Fig. 3-3, lines 2 to 4).
template <class R> class BaseTexelTwin {
    using Vec2 = typename R::Vec2;
    using Vec4 = typename R::Vec4;

  public:
    using Texel = typename R::IVec2;

    BaseTexelTwin(R& reading, const FrameParams& params) : r(reading), params_(params) {}

    [[nodiscard]] Vec4 clip(const typename R::Vec3& position) const {
        const auto& m = r.uniform(site::proj_view, params_.collision_proj_view);
        return r.note(site::clip, r.transform(site::clip, m, position));
    }

    [[nodiscard]] Texel size() const { return r.uniform(site::client_size, glm::ivec2(params_.width, params_.height)); }

    [[nodiscard]] Vec2 image_position(const Vec4& clip) const {
        Vec2 p{clip.x, clip.y};
        if (r.setting(site::perspective_divide, params_.switches.perspective_divide == PerspectiveDivide::on))
            p = r.note(site::ndc, Vec2{r.divide(site::ndc, clip.x, clip.w), r.divide(site::ndc, clip.y, clip.w)});
        else
            p = r.note(site::not_divided, p);
        p = r.note(site::texture_coordinate, (p + 1.0F) * r.uniform(site::half, 0.5F));
        const Texel image = size();
        return r.note(site::image_position, p * r.note(site::scale, Vec2{r.real(image.x), r.real(image.y)}));
    }

    /// The cast is only made where it is defined.
    [[nodiscard]] std::optional<Texel> base_texel(const Vec2& p) const {
        const Texel image = size();
        const bool floors = r.setting(site::base_by_floor, params_.switches.base_texel == BaseTexel::floor);
        const auto left = floors ? p.x >= 0.0F && p.y >= 0.0F : p.x > -1.0F && p.y > -1.0F;
        if (!r.decide(site::base_texel, left && p.x < r.real(image.x) && p.y < r.real(image.y)))
            return {};
        return r.note(site::base_texel, Texel{r.to_int(site::base_texel, p.x), r.to_int(site::base_texel, p.y)});
    }

  private:
    R& r;
    const FrameParams& params_;
};

/// One particle's step, as the listing reads (thesis, Fig. 3-3), over a reading `R`. Twin of
/// shaders/collision/collision_pass.vert.
template <class R> class CollisionTwin {
    using Real = typename R::Real;
    using Int = typename R::Int;
    using Vec3 = typename R::Vec3;
    using Texel = typename R::IVec2;

  public:
    struct Collision {
        Texel base;  ///< the texel searched round
        Texel texel; ///< the one whose position is nearest
        Vec3 away;   ///< own position minus the one stored there
        auto fields() { return std::tie(base, texel, away); }
        auto fields() const { return std::tie(base, texel, away); }
    };
    struct State : ParticleTwinState<R> {
        std::optional<Collision> hit = {};
    };

    CollisionTwin(R& reading, const CollisionImage& cdt, const FrameParams& params)
        : r(reading), cdt_(cdt), params_(params), constants_(params.constants), switches_(params.switches),
          box_step_((params.cdt_box.max - params.cdt_box.min) / 255.0F), image_(reading, params),
          particle_(reading, params) {
        if constexpr (requires { reading.foretell(params); })
            reading.foretell(params);
    }

    [[nodiscard]] State operator()(const ParticleState& before) const {
        const ParticleTwinState<R> a = particle_.read(before);
        const auto position = image_.image_position(image_.clip(a.position));
        if (r.decide(site::searches, a.collide_time < 0.0F)) {
            if (const auto base = image_.base_texel(position))
                if (const auto hit = nearest_collision(a.position, *base))
                    return {particle_.collide(a, hit->away), hit};
        } else if (r.setting(site::stands, switches_.not_searching == NotSearching::stands)) {
            return {particle_.stand(a)};
        }
        return {particle_.integrate(a)};
    }

    /// Where a search from `position` ends, whatever the collide time.
    [[nodiscard]] std::optional<Collision> collision(glm::vec3 position) const {
        const Vec3 own = r.read(site::position_before, position);
        const auto base = image_.base_texel(image_.image_position(image_.clip(own)));
        return base ? nearest_collision(own, *base) : std::nullopt;
    }

  private:
    [[nodiscard]] bool holds_particle(const glm::vec4& stored) const {
        return r.setting(site::phantom, switches_.empty_texel == EmptyTexel::phantom) ||
               r.decide(site::holds_particle, stored.a != 0.0F);
    }

    [[nodiscard]] Vec3 decode(const glm::vec4& stored) const {
        Vec3 position = r.read(site::stored, glm::vec3(stored));
        if (r.setting(site::scaled_to_box, switches_.cdt_format == CdtFormat::rgba8))
            position = r.uniform(site::box_low, params_.cdt_box.min) + position * r.uniform(site::box_step, box_step_);
        return r.note(site::stored_position, position);
    }

    /// Lines 5 to 19: the nearest stored position within the collision range.
    [[nodiscard]] std::optional<Collision> nearest_collision(const Vec3& position, const Texel& base) const {
        const Texel size = image_.size();
        Vec3 own = position;
        if (r.setting(site::own_from_texel, switches_.self_position == SelfPosition::texel)) {
            const glm::vec4* self = r.fetch(site::own_texel, cdt_, size, base);
            if (self == nullptr || !holds_particle(*self))
                return {};
            own = decode(*self);
        }
        own = r.note(site::own_position, own);
        const bool zero_hits = r.setting(site::zero_distance_hits, switches_.zero_distance == ZeroDistance::hit);
        const Real range = r.uniform(site::collision_range, constants_.collision_range);
        const Int reach = r.uniform(site::texel_collide_range, constants_.texel_collide_range);
        auto nearest = least<Collision>(r, site::nearest, 100000.0F);
        for (const Int ty : r.range(site::rows, -reach, reach)) {
            for (const Int tx : r.range(site::columns, -reach, reach)) {
                if (r.decide(site::own_texel_skipped, tx == 0 && ty == 0))
                    continue;
                const Texel texel = base + Texel{tx, ty};
                const glm::vec4* stored = r.fetch(site::neighbour, cdt_, size, texel);
                if (stored == nullptr || !holds_particle(*stored))
                    continue;
                const Vec3 apart = r.note(site::apart, own - decode(*stored));
                const Real len = r.note(site::distance, r.length(site::distance, apart));
                nearest.offer(site::in_range, range > len && (zero_hits || len != 0.0F), len, {base, texel, apart});
            }
        }
        return nearest.take();
    }

    R& r;
    const CollisionImage& cdt_;
    const FrameParams& params_;
    const Constants& constants_;
    const Switches& switches_;
    glm::vec3 box_step_;
    BaseTexelTwin<R> image_;
    ParticleTwin<R> particle_;
};

} // namespace lockstep
