#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/particle_twin.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/image.hpp"
#include "reference/readings/values.hpp"

namespace lockstep {

namespace site {
inline constexpr Site second_proj_view{"u_SecondProjView"};
inline constexpr Site own_matrix{"camera's own matrix"};
inline constexpr Site own_planes{"camera's own planes"};
inline constexpr Site reach{"u_Reach"};
inline constexpr Site second_reach{"u_SecondReach"};
inline constexpr Site cameras{"collision cameras"};
inline constexpr Site window_margin{"u_WindowMargin"};
inline constexpr Site window_reach{"window's reach"};
inline constexpr Site projected_window{"projected window"};
inline constexpr Site before{"clip w before"};
inline constexpr Site behind{"clip w behind"};
inline constexpr Site hidden{"out of reach behind", {}, "world units"};
inline constexpr Site obstacles{"obstacles' plane"};
inline constexpr Site stops_at_no_obstacle{"layers end at no obstacle"};
inline constexpr Site layers{"layers"};
inline constexpr Site itself_stored{"own position as stored"};
inline constexpr Site is_itself{"stored is itself"};
inline constexpr Site itself_skipped{"itself is skipped"};
inline constexpr Site mutual{"mutual response"};
inline constexpr Site other_velocity{"other's velocity"};
inline constexpr Site other_searches{"other searches"};
inline constexpr Site relative{"relative velocity"};
inline constexpr Site approaches{"approaches"};
inline constexpr Site approaches_wall{"approaches the obstacle"};
inline constexpr Site share{"share of the bounce"};
inline constexpr Site wall_share{"share of the bounce off the obstacle"};
inline constexpr Site unseen_pushed{"unseen is pushed"};
inline constexpr Site along{"part along"};
inline constexpr Site adds_up{"contacts add up"};
inline constexpr Site change{"change by a contact"};
inline constexpr Site after_contacts{"velocity after contacts"};
inline constexpr Site after_wall{"velocity after the obstacle"};
inline constexpr Site stands_still{"stands still"};
} // namespace site

/// One particle's step with the remedies (reference/model/collision/layered_cdt.hpp), over a reading `R`: everything
/// stored in its windows, in all layers of each collision camera's CDT. Twin of
/// shaders/collision/layered_collision_pass.vert.
template <class R> class LayeredTwin {
    using Real = typename R::Real;
    using Int = typename R::Int;
    using Vec3 = typename R::Vec3;
    using Vec4 = typename R::Vec4;
    using Texel = typename R::IVec2;
    using Particle = ParticleTwinState<R>;

  public:
    LayeredTwin(R& reading, const CollisionImage& cdt, const FrameParams& params)
        : r(reading), cdt_(cdt), params_(params), switches_(params.switches), planes_(cdt_planes(params.switches)),
          code_(params), box_step_((params.cdt_box.max - params.cdt_box.min) / 255.0F),
          reach_{projected_reach(params.collision_proj_view, params),
                 planes_.cameras > 1 ? projected_reach(params.second_proj_view, params) : glm::vec3(0.0F)},
          particle_(reading, params) {}

    [[nodiscard]] Particle operator()(const ParticleState& before) const {
        const Particle a = particle_.read(before);
        if (r.decide(site::searches, a.collide_time < 0.0F)) {
            Contacts contacts = search(a);
            if (r.setting(site::mutual, switches_.response == Response::mutual)) {
                if (const auto velocity = velocity_after(a, contacts))
                    return rebound(a, *velocity);
            } else if (const auto nearest = contacts.nearest.take()) {
                return particle_.collide(a, *nearest);
            }
        }
        return particle_.integrate(a);
    }

  private:
    using Nearest = decltype(least<Vec3>(std::declval<R&>(), site::nearest, 0.0F));
    /// What the search has found; `nearest`: own position minus the stored one, with mutual response of obstacles
    /// alone.
    struct Contacts {
        Nearest nearest;
        Vec3 change{}; ///< of the velocity, by particles
        bool pushed = false, seen = false;
    };

    [[nodiscard]] Vec3 decode(const Vec3& stored) const {
        if (!r.setting(site::scaled_to_box, switches_.cdt_format == CdtFormat::rgba8))
            return stored;
        return r.uniform(site::box_low, params_.cdt_box.min) + stored * r.uniform(site::box_step, box_step_);
    }
    /// What comes back of a vector that has been stored.
    [[nodiscard]] Vec3 as_stored(const Vec3& v) const {
        const auto encoded = [&](Real x, int c) {
            return r.monotone(x, [&](float value) {
                glm::vec3 all(0.0F);
                all[c] = value;
                return code_.encode(all)[c];
            });
        };
        return decode({encoded(v.x, 0), encoded(v.y, 1), encoded(v.z, 2)});
    }
    [[nodiscard]] const glm::vec4& texel(int plane, int x, int y) const {
        return cdt_.at(x, plane * params_.height + y);
    }

    [[nodiscard]] Contacts search(const Particle& a) const {
        Contacts contacts{least<Vec3>(r, site::nearest, 100000.0F)};
        const Vec3 self = r.note(site::itself_stored, as_stored(a.position));
        for (const int camera : r.range(site::cameras, 0, planes_.cameras - 1)) {
            const bool first = camera == 0;
            const auto& proj_view = first || !r.setting(site::own_matrix, true)
                                        ? r.uniform(site::proj_view, params_.collision_proj_view)
                                        : r.uniform(site::second_proj_view, params_.second_proj_view);
            const Vec3 reach = r.uniform(first ? site::reach : site::second_reach, reach_[first ? 0 : 1]);
            const int planes_of = r.setting(site::own_planes, true) ? camera : 0;
            const Vec4 clip = r.note(site::clip, r.transform(site::clip, proj_view, a.position));
            const Texel size = r.uniform(site::client_size, glm::ivec2(params_.width, params_.height));
            const auto placed = [&](Real c, Int pixels) {
                return (r.divide(site::ndc, c, clip.w) + 1.0F) * r.uniform(site::half, 0.5F) * r.real(pixels);
            };
            const typename R::Vec2 at =
                r.note(site::image_position, typename R::Vec2{placed(clip.x, size.x), placed(clip.y, size.y)});
            if (!r.decide(site::base_texel,
                          at.x >= 0.0F && at.y >= 0.0F && at.x < r.real(size.x) && at.y < r.real(size.y)))
                continue;
            const Real before = r.note(site::before, clip.w - reach.z);
            const Real behind = r.note(site::behind, clip.w + reach.z);
            const auto columns = window(at.x, r.divide(site::window_reach, reach.x, before), params_.width);
            const auto rows = window(at.y, r.divide(site::window_reach, reach.y, before), params_.height);
            for (const Int y : r.range(site::rows, rows[0], rows[1]))
                for (const Int x : r.range(site::columns, columns[0], columns[1]))
                    look(a, self, planes_of, proj_view, behind, x, y, contacts);
        }
        return contacts;
    }

    /// First and last texel along one axis.
    [[nodiscard]] std::array<int, 2> window(Real at, Real reach, int size) const {
        const int base = r.to_int(site::base_texel, at);
        const int range = r.uniform(site::texel_collide_range, params_.constants.texel_collide_range);
        int low = base - range, high = base + range;
        if (r.setting(site::projected_window, switches_.search_window == SearchWindow::projected)) {
            const Real around = r.note(site::window_reach, reach + r.uniform(site::window_margin, window_margin));
            if (r.decide(site::projected_window, reach >= 0.0F && around < r.real(range))) {
                low = std::max(low, int(r.to_int(site::window_reach, r.floor(at - around))));
                high = std::min(high, int(r.to_int(site::window_reach, r.floor(at + around))));
            }
        }
        return {std::max(low, 0), std::min(high, size - 1)};
    }

    /// A texel's obstacle, then its layers from the front, up to one that is empty or out of reach.
    template <class Matrix> void look(const Particle& a, const Vec3& self, int camera, const Matrix& proj_view,
                                      Real behind, int x, int y, Contacts& contacts) const {
        if (!cdt_.contains(x, y))
            return;
        const auto reaches = [&](int layer) {
            const glm::vec4& code = texel(planes_.position(camera, layer), x, y);
            const Vec3 stored = r.note(site::stored_position, decode(r.read(site::stored, glm::vec3(code))));
            if (!r.decide(site::holds_particle, code.a != 0.0F) ||
                r.decide(site::hidden, r.transform(site::behind, proj_view, stored).w > behind))
                return false;
            meet(a, self, stored, camera, layer, x, y, contacts);
            return true;
        };
        if (r.setting(site::obstacles, true) && !reaches(-1) && r.setting(site::stops_at_no_obstacle, false))
            return;
        for (const int layer : r.range(site::layers, 0, planes_.layers - 1))
            if (!reaches(layer))
                return;
    }

    void meet(const Particle& a, const Vec3& self, const Vec3& stored, int camera, int layer, int x, int y,
              Contacts& contacts) const {
        const bool obstacle = layer < 0;
        const bool mutual = switches_.response == Response::mutual;
        const Vec3 apart =
            r.note(site::apart, (mutual && r.setting(site::itself_stored, true) ? self : a.position) - stored);
        const Real length = r.note(site::distance, r.length(site::distance, apart));
        const bool own = r.decide(site::is_itself, stored.x == self.x && stored.y == self.y && stored.z == self.z);
        contacts.seen = contacts.seen || (own && !obstacle);
        if (own && r.setting(site::itself_skipped, true))
            return;
        const Real range = r.uniform(site::collision_range, params_.constants.collision_range);
        if (!mutual || obstacle) {
            contacts.nearest.offer(site::in_range, range > length && length != 0.0F, length, apart);
            return;
        }
        if (!r.decide(site::in_range, range > length && length != 0.0F))
            return;
        const glm::vec4& other = texel(planes_.velocity(camera, layer), x, y);
        const Vec3 velocity = r.note(site::velocity_before, a.direction * a.speed);
        const Vec3 relative =
            r.note(site::relative, as_stored(velocity) - r.read(site::other_velocity, decoded(other)));
        if (!r.decide(site::other_searches, other.a != 0.0F) ||
            !r.decide(site::approaches, r.dot(site::approaches, relative, apart) < 0.0F))
            return;
        const Vec3 so_far = r.setting(site::adds_up, true) ? contacts.change : Vec3{};
        contacts.change = r.note(site::change, so_far + bounce(site::share, relative, apart, 0.5F));
        contacts.pushed = true;
    }
    /// The velocity planes are read as they stand.
    static glm::vec3 decoded(const glm::vec4& code) { return glm::vec3(code); }

    /// What a contact adds to the velocity: -share * (1 + restitution) * the component of `relative` along `apart`.
    [[nodiscard]] Vec3 bounce(const Site& place, const Vec3& relative, const Vec3& apart, float share) const {
        const Real part = r.note(
            site::along, r.divide(site::along, r.dot(site::along, relative, apart), r.dot(site::along, apart, apart)));
        const Real weight = r.uniform(place, -share) * (r.uniform(site::speed_factor, switches_.speed_factor) + 1.0F);
        return apart * (part * weight);
    }

    /// Where there is a contact to answer.
    [[nodiscard]] std::optional<Vec3> velocity_after(const Particle& a, Contacts& contacts) const {
        const bool pushed = contacts.pushed && (contacts.seen || r.setting(site::unseen_pushed, false));
        Vec3 velocity = a.direction * a.speed;
        if (pushed)
            velocity = r.note(site::after_contacts, velocity + contacts.change);
        bool reflected = false;
        if (const auto wall = contacts.nearest.take())
            if (r.decide(site::approaches_wall, r.dot(site::approaches_wall, velocity, *wall) < 0.0F)) {
                velocity = r.note(site::after_wall, velocity + bounce(site::wall_share, velocity, *wall, 1.0F));
                reflected = true;
            }
        return pushed || reflected ? std::optional(velocity) : std::nullopt;
    }

    [[nodiscard]] Particle rebound(const Particle& a, const Vec3& velocity) const {
        Particle v;
        v.speed = r.note(site::speed_at_hit, r.length(site::speed_at_hit, velocity));
        v.direction = a.direction;
        if (!r.decide(site::stands_still, v.speed == 0.0F))
            v.direction = r.normalize(site::direction_at_hit, velocity);
        v.direction = r.note(site::direction_at_hit, v.direction);
        v.collide_time =
            r.note(site::collide_time_at_hit, r.uniform(site::collision_time, params_.constants.collision_time));
        Vec3 step = velocity;
        if (r.setting(site::step_by_tick, switches_.collision_step == CollisionStep::tick))
            step = step * r.uniform(site::tick, params_.constants.tick);
        v.position = r.note(site::position_at_hit, a.position + step);
        return v;
    }

    R& r;
    const CollisionImage& cdt_;
    const FrameParams& params_;
    const Switches& switches_;
    CdtPlanes planes_;
    CollisionCode code_;
    glm::vec3 box_step_;
    std::array<glm::vec3, 2> reach_; ///< what the host hands in for each camera
    ParticleTwin<R> particle_;
};

} // namespace lockstep
