#pragma once
#include "reference/dust/grain.hpp"
#include "reference/model/dust/host.hpp"

/// What grains bounce off. Twin of shaders/dust/colliders.glsl.
namespace lockstep::dust {

template <class R> struct Movement { typename R::Vec3 current, next, velocity; };

/// Cuts a movement at the contact; the rest is mirrored and shortened, the velocity mirrored and slowed down as a
/// whole.
template <class R> class ColliderTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    using Axis = Real Vec3::*;

  public:
    ColliderTwin(R& reading, const Host& host, const Colliders& colliders)
        : r(reading), host_(host), colliders_(colliders), switches_(host.switches()),
          radius_(r.uniform(site::radius, host.radius())),
          elasticity_(r.uniform(site::elasticity, host.settings().elasticity)) {}

    /// The list's spheres, then its boxes: the first that is hit, or, without one_hit, each.
    void list(Movement<R>& m) const {
        bool hit = false;
        const bool one = r.setting(site::one_hit, switches_.one_hit == OffOn::on);
        if (r.setting(site::has_spheres, true))
            for (const int k : r.range(site::spheres, 0, static_cast<int>(colliders_.spheres.size()) - 1))
                if (!(one && hit))
                    hit = sphere(colliders_.spheres[static_cast<std::size_t>(k)], m) || hit;
        if (r.setting(site::has_boxes, true))
            for (const int k : r.range(site::boxes, 0, static_cast<int>(colliders_.boxes.size()) - 1))
                if (!(one && hit))
                    hit = box(colliders_.boxes[static_cast<std::size_t>(k)], m) || hit;
    }

    void world(Movement<R>& m) const {
        switch (switches_.world) {
        case World::none:
            return;
        case World::floor_clamp:
            if (!r.decide(site::above_floor, m.next.y > 0.0F))
                m.next.y = 0.0F;
            return;
        case World::floor_radius:
            if (!r.decide(site::above_floor, m.next.y > radius_))
                m.next.y = radius_;
            return;
        case World::floor_bounce:
            if (r.decide(site::below_floor, m.next.y < radius_))
                wall(m, &Vec3::y, radius_, m.current.y <= radius_, false);
            return;
        case World::box:
            return walls(m);
        }
    }

  private:
    bool sphere(const ColliderMatrices& collider, Movement<R>& m) const {
        const Vec3 centre = r.uniform(site::sphere_centre, glm::vec3(collider.local_to_world[3]));
        const Real half = switches_.sphere_data == SphereData::vec4
                              ? r.note(site::sphere_half, r.uniform(site::sphere_radius, collider.scale.x * 0.5F))
                              : r.note(site::sphere_half, r.uniform(site::sphere_radius, collider.scale.x) * 0.5F);
        const Real reach = r.note(site::reach, radius_ + half);
        const Real sqr_reach = reach * reach;
        const Real d2 = r.note(site::sqr_dist, squared(r.note(site::from_centre, m.next - centre)));
        const bool touches = switches_.sphere_touch == SphereTouch::less
                                 ? r.decide(site::touches_sphere, d2 < sqr_reach)
                                 : r.decide(site::touches_sphere, d2 <= sqr_reach);
        if (!touches && switches_.sweep == OffOn::off)
            return false;
        if (touches && switches_.inside == Inside::push_out &&
            r.decide(site::starts_inside, squared(m.current - centre) < sqr_reach)) {
            push_out(centre, reach, m);
            return true;
        }
        const Vec3 ray = r.note(site::movement, m.next - m.current);
        const Vec3 n = r.note(site::movement_unit, direction_of(r, site::movement_unit, ray, switches_));
        const Vec3 a = r.note(site::to_centre, centre - m.current);
        const Real q = r.note(site::closest, r.dot(site::closest, a, n));
        const Real h = r.note(site::missed, r.note(site::sqr_way, squared(a)) - r.note(site::closest_squared, q * q));
        Real chord = r.note(site::chord, sqr_reach - h);
        if (!touches && !r.decide(site::crosses_sphere, chord > 0.0F))
            return false;
        if (switches_.root == Root::clamp && r.decide(site::grazes, chord < 0.0F))
            chord = 0.0F;
        const Real g = r.note(site::root, r.sqrt(site::root, chord));
        if (!touches && !r.decide(site::comes_to_contact, q - g >= 0.0F && (q - g) * (q - g) <= squared(ray)))
            return false;
        const Vec3 contact = r.note(site::contact, m.current + n * (q - g));
        const Vec3 normal = r.note(site::normal, divided(r, site::normal, contact - centre, reach));
        const Vec3 rest = r.note(site::rest, m.next - contact);
        m.next = r.note(site::landed,
                        contact + reflected(site::into, rest, normal) * r.note(site::sphere_path_kept, elasticity_));
        m.velocity = r.note(site::bounced, reflected(site::speed_into, m.velocity, normal) *
                                               r.note(site::sphere_speed_kept, elasticity_));
        return true;
    }

    /// To the nearest place of the sphere's surface, on no way further in.
    void push_out(const Vec3& centre, const Real& reach, Movement<R>& m) const {
        const Vec3 out = r.note(site::outward, r.normalize(site::outward, m.next - centre));
        m.next = r.note(site::landed, centre + out * reach);
        if (r.decide(site::moves_inward,
                     r.note(site::speed_outward, r.dot(site::speed_outward, m.velocity, out)) < 0.0F))
            m.velocity = r.note(site::bounced, reflected(site::speed_into, m.velocity, out) *
                                                   r.note(site::sphere_speed_kept, elasticity_));
    }

    /// i - (2 i.n) n
    Vec3 reflected(At place, const Vec3& i, const Vec3& n) const {
        const Real twice = r.note(place, r.dot(place, i, n)) * 2.0F;
        return i - n * twice;
    }

    bool box(const ColliderMatrices& collider, Movement<R>& m) const {
        return switches_.box_kind == BoxKind::aabb ? aabb(collider, m) : obb(collider, m);
    }

    bool aabb(const ColliderMatrices& collider, Movement<R>& m) const {
        const Vec3 centre = r.uniform(site::box_centre, glm::vec3(collider.local_to_world[3]));
        const Vec3 half = r.note(site::half_box, r.uniform(site::box_scale, collider.scale) * 0.5F);
        const Vec3 min = r.note(site::box_min, centre - half), max = r.note(site::box_max, centre + half);
        const Vec3 lo = less(min, radius_), hi = more(max, radius_);
        bool touches = false;
        if (switches_.box_detect == BoxDetect::boxed) {
            touches = !r.decide(site::misses_box, m.next.x < lo.x || m.next.x > hi.x || m.next.y < lo.y ||
                                                      m.next.y > hi.y || m.next.z < lo.z || m.next.z > hi.z);
        } else {
            const Vec3 nearest{clamped(m.next.x, min.x, max.x), clamped(m.next.y, min.y, max.y),
                               clamped(m.next.z, min.z, max.z)};
            touches = r.decide(site::touches_box, r.note(site::sqr_gap, squared(r.note(site::gap, m.next - nearest))) <=
                                                      r.note(site::sqr_radius, radius_ * radius_));
        }
        return answer(m, lo, hi, touches);
    }

    bool obb(const ColliderMatrices& collider, Movement<R>& m) const {
        const glm::mat4 to_local = r.uniform(site::world_to_local, collider.world_to_local);
        const glm::mat4 to_world = r.uniform(site::local_to_world, collider.local_to_world);
        const Vec3 scale = r.uniform(site::box_scale, collider.scale);
        const Vec3 rho = r.note(site::half_grain, Vec3{r.divide(site::half_grain, radius_, scale.x),
                                                       r.divide(site::half_grain, radius_, scale.y),
                                                       r.divide(site::half_grain, radius_, scale.z)});
        Movement<R> local;
        local.current = r.note(site::current_in_box, place(to_local, m.current));
        local.next = r.note(site::next_in_box, place(to_local, m.next));
        const Vec3 margin = r.note(site::touch_margin, rho);
        const Vec3 above = local.next + margin, below = local.next - margin;
        const bool touches = !r.decide(site::misses_box, above.x < -0.5F || below.x > 0.5F || above.y < -0.5F ||
                                                             below.y > 0.5F || above.z < -0.5F || below.z > 0.5F);
        if (!touches && switches_.sweep == OffOn::off)
            return false;
        local.velocity = r.note(site::speed_in_box, direction(to_local, m.velocity));
        if (!answer(local, {-0.5F - rho.x, -0.5F - rho.y, -0.5F - rho.z}, more(rho, 0.5F), touches))
            return false;
        m.next = r.note(site::landed, place(to_world, local.next));
        m.velocity = r.note(site::bounced, direction(to_world, local.velocity));
        return true;
    }

    /// A face of a grown box that a movement's line comes to.
    struct Face {
        Axis axis = nullptr; ///< none: no face is entered
        bool heads_up = false;
        Vec3 contact{};
    };

    /// The answer to a grown box, unless the movement misses it.
    bool answer(Movement<R>& m, const Vec3& lo, const Vec3& hi, bool touches) const {
        if (!touches && switches_.sweep == OffOn::off)
            return false;
        const Vec3 ray = r.note(site::movement, m.next - m.current);
        r.note(site::speed_before_box, m.velocity);
        const Face face = face_of(m, ray, lo, hi);
        if (!touches && !passes(face, m, lo, hi))
            return false;
        const Vec3 contact = r.note(site::contact, face.contact);
        const Real length = r.note(site::length_of_movement, r.length(site::length_of_movement, ray));
        const Real in = r.note(site::way_in, r.length(site::way_in, contact - m.current));
        const Real out = r.note(
            site::way_out, r.divide(site::way_out, (length - in) * r.note(site::box_path_kept, elasticity_), length));
        m.next = r.note(site::answered, contact + mirrored(face.axis, ray) * out);
        m.velocity = r.note(site::speed_answered, r.note(site::box_mirrored, mirrored(face.axis, m.velocity)) *
                                                      r.note(site::box_speed_kept, elasticity_));
        return true;
    }

    /// The first, x before y before z, that the ray enters the grown box by; of none the contact is z's.
    Face face_of(const Movement<R>& m, const Vec3& ray, const Vec3& lo, const Vec3& hi) const {
        Face face = on_face(&Vec3::x, m.current, ray, lo, hi);
        const Vec3& contact = face.contact;
        if (r.decide(site::face_x, contact.y >= lo.y && contact.y <= hi.y && contact.z >= lo.z && contact.z <= hi.z))
            return face;
        face = on_face(&Vec3::y, m.current, ray, lo, hi);
        if (r.decide(site::face_y, contact.x >= lo.x && contact.x <= hi.x && contact.z >= lo.z && contact.z <= hi.z))
            return face;
        face = on_face(&Vec3::z, m.current, ray, lo, hi);
        if (!r.decide(site::face_z, contact.x >= lo.x && contact.x <= hi.x && contact.y >= lo.y && contact.y <= hi.y))
            face.axis = nullptr;
        return face;
    }

    /// Whether the movement comes from beyond the face to behind it.
    bool passes(const Face& face, const Movement<R>& m, const Vec3& lo, const Vec3& hi) const {
        if (face.axis == nullptr)
            return false;
        const Real &from = m.current.*face.axis, &to = m.next.*face.axis;
        const Real& plane = face.heads_up ? lo.*face.axis : hi.*face.axis;
        return face.heads_up ? r.decide(site::passes_up, from <= plane && plane <= to)
                             : r.decide(site::passes_down, from >= plane && plane >= to);
    }

    /// Where the ray comes to a box's face across an axis.
    Face on_face(Axis axis, const Vec3& current, const Vec3& ray, const Vec3& lo, const Vec3& hi) const {
        const bool heads_up = r.decide(site::heads_up, ray.*axis >= 0.0F);
        const Real plane = heads_up ? lo.*axis : hi.*axis;
        Vec3 along = ray;
        if (switches_.plane_cast == PlaneCast::normalized)
            along = r.note(site::movement_unit, r.normalize(site::movement_unit, ray));
        const Real t = r.note(site::time_of_face, r.divide(site::time_of_face, plane - current.*axis, along.*axis));
        Vec3 contact = current + along * t;
        if (r.setting(site::on_face, true))
            contact.*axis = plane;
        return {axis, heads_up, contact};
    }

    void walls(Movement<R>& m) const {
        const Real margin = r.note(site::wall_margin, radius_);
        const Vec3 hi =
            less(r.uniform(site::world_max, host_.settings().world.max), r.note(site::upper_margin, margin));
        const Vec3 lo =
            more(r.uniform(site::world_min, host_.settings().world.min), r.note(site::lower_margin, margin));
        for (const Axis axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const Real low = r.note(site::lower_limit, lo.*axis), high = r.note(site::upper_limit, hi.*axis);
            if (r.decide(site::above_wall, m.next.*axis > hi.*axis)) {
                wall(m, axis, high, m.current.*axis > hi.*axis, true);
                if (r.setting(site::upper_alone, switches_.walls == Walls::first))
                    return;
            }
            if (r.decide(site::below_wall, m.next.*axis < lo.*axis)) {
                wall(m, axis, low, m.current.*axis < lo.*axis, false);
                if (r.setting(site::lower_alone, switches_.walls == Walls::first))
                    return;
            }
        }
    }

    /// A plane that the movement crosses from inside, or started beyond: then it ends on it, and nothing bounces.
    template <class Condition>
    void wall(Movement<R>& m, Axis axis, const Real& limit, const Condition& beyond, bool is_upper) const {
        if (r.decide(site::started_beyond, beyond)) {
            m.next.*axis = limit;
            if (switches_.clamp_velocity == ClampVelocity::zero) {
                const Real speed = m.velocity.*axis;
                m.velocity.*axis = is_upper ? r.min(speed, 0.0F) : r.max(speed, 0.0F);
            }
            return;
        }
        const Vec3 ray = r.note(site::movement, m.next - m.current);
        const Vec3 n = r.note(site::movement_unit, r.normalize(site::movement_unit, ray));
        const Real d = r.note(site::to_wall, r.divide(site::to_wall, limit - m.current.*axis, n.*axis));
        const Vec3 contact = r.note(site::contact, m.current + n * d);
        const Real length = r.note(site::length_of_movement, r.length(site::length_of_movement, ray));
        const Real in = r.note(site::way_in, r.length(site::way_in, m.current - contact));
        const Real out = r.note(
            site::way_out, r.divide(site::way_out, (length - in) * r.note(site::wall_path_kept, elasticity_), length));
        m.next = r.note(site::landed, contact + mirrored(axis, ray) * out);
        m.velocity = r.note(site::bounced, mirrored(axis, m.velocity) * r.note(site::wall_speed_kept, elasticity_));
    }

    static Vec3 mirrored(Axis axis, Vec3 v) {
        if (axis != nullptr)
            v.*axis = -(v.*axis);
        return v;
    }
    static Vec3 more(const Vec3& v, const Real& s) { return {v.x + s, v.y + s, v.z + s}; }
    static Vec3 less(const Vec3& v, const Real& s) { return {v.x - s, v.y - s, v.z - s}; }
    Real clamped(const Real& x, const Real& low, const Real& high) const { return r.min(r.max(x, low), high); }

    /// m (v, 1), each operation rounded.
    Vec3 place(const glm::mat4& m, const Vec3& v) const {
        return direction(m, v) + r.note(site::translation, Vec3{m[3][0], m[3][1], m[3][2]});
    }
    /// m (v, 0)
    Vec3 direction(const glm::mat4& m, const Vec3& v) const { return turned(r, m, v); }

    R& r;
    const Host& host_;
    const Colliders& colliders_;
    const Switches& switches_;
    Real radius_, elasticity_;
};

} // namespace lockstep::dust
