// What grains bounce off: the movement is cut at the contact, the rest mirrored and shortened, the velocity mirrored and
// slowed down as a whole. Twin: reference/dust/colliders.hpp.

// localToWorld, worldToLocal (columns), scale: 35 floats a collider.
layout(std430) readonly buffer sphereColliderBuffer { float sphereColliders[]; };
layout(std430) readonly buffer boxColliderBuffer { float boxColliders[]; };

uniform int sphereColliderCount, boxColliderCount;
uniform vec3 worldBoundsMin, worldBoundsMax;
uniform float radius, elasticity;

struct Movement {
    vec3 current, next, velocity;
};

vec3 mirrored(vec3 v, int axis) {
    if (axis >= 0)
        v[axis] = neg(v[axis]);
    return v;
}

vec3 reflected(vec3 i, vec3 n) { return sub(i, mul(n, mul(ls_dot(i, n), 2.0))); }

bool sphere(int k, inout Movement m) {
#if SPHERE_DATA == SPHERE_DATA_VEC4
    int first = 4 * k;
    vec3 centre = vec3(sphereColliders[first], sphereColliders[first + 1], sphereColliders[first + 2]);
    float reach = add(radius, sphereColliders[first + 3]);
#else
    int first = 35 * k;
    vec3 centre = vec3(sphereColliders[first + 12], sphereColliders[first + 13], sphereColliders[first + 14]);
    float reach = add(radius, mul(sphereColliders[first + 32], 0.5));
#endif
    float sqr_reach = mul(reach, reach);
    float d2 = squared(sub(m.next, centre));
#if SPHERE_TOUCH == SPHERE_TOUCH_LESS
    bool touches = d2 < sqr_reach;
#else
    bool touches = d2 <= sqr_reach;
#endif
#if SWEEP == SWEEP_OFF
    if (!touches)
        return false;
#endif
#if INSIDE == INSIDE_PUSH_OUT
    if (touches && squared(sub(m.current, centre)) < sqr_reach) {
        vec3 outward = ls_normalize(sub(m.next, centre));
        m.next = add(centre, mul(outward, reach));
        if (ls_dot(m.velocity, outward) < 0.0)
            m.velocity = mul(reflected(m.velocity, outward), elasticity);
        return true;
    }
#endif
    vec3 n = direction_of(sub(m.next, m.current));
    vec3 a = sub(centre, m.current);
    float q = ls_dot(a, n);
    float h = sub(squared(a), mul(q, q));
    float chord = sub(sqr_reach, h);
#if SWEEP == SWEEP_ON
    if (!touches && !(chord > 0.0))
        return false;
#endif
#if ROOT == ROOT_CLAMP
    if (chord < 0.0)
        chord = 0.0;
#endif
#if SWEEP == SWEEP_ON
    float way = sub(q, ls_sqrt(chord));
    if (!touches && !(way >= 0.0 && mul(way, way) <= squared(sub(m.next, m.current))))
        return false;
#endif
    vec3 contact = add(m.current, mul(n, sub(q, ls_sqrt(chord))));
    vec3 normal = divided(sub(contact, centre), reach);
    m.next = add(contact, mul(reflected(sub(m.next, contact), normal), elasticity));
    m.velocity = mul(reflected(m.velocity, normal), elasticity);
    return true;
}

// Where the movement comes to the box's face across an axis.
vec3 on_face(int axis, vec3 current, vec3 ray, vec3 lo, vec3 hi) {
    float plane = ray[axis] >= 0.0 ? lo[axis] : hi[axis];
#if PLANE_CAST == PLANE_CAST_NORMALIZED
    ray = ls_normalize(ray);
#endif
    float t = ls_divide(sub(plane, current[axis]), ray[axis]);
    vec3 contact = add(current, mul(ray, t));
    contact[axis] = plane;
    return contact;
}

// Whether the movement comes from beyond a face to behind it.
bool passes(int axis, vec3 ray, Movement m, vec3 lo, vec3 hi) {
    if (axis < 0)
        return false;
    float from = m.current[axis], to = m.next[axis];
    return ray[axis] >= 0.0 ? from <= lo[axis] && lo[axis] <= to : from >= hi[axis] && hi[axis] >= to;
}

// The answer to a grown box, by the first face, x before y before z, that the movement enters it by; false where it
// misses the box.
bool answer(vec3 lo, vec3 hi, bool touches, inout Movement m) {
    vec3 ray = sub(m.next, m.current);
    int axis = -1;
    vec3 contact;
    for (int face = 0; face < 3 && axis < 0; ++face) {
        contact = on_face(face, m.current, ray, lo, hi);
        int b = face == 0 ? 1 : 0, c = face == 2 ? 1 : 2;
        if (contact[b] >= lo[b] && contact[b] <= hi[b] && contact[c] >= lo[c] && contact[c] <= hi[c])
            axis = face;
    }
#if SWEEP == SWEEP_ON
    if (!touches && !passes(axis, ray, m, lo, hi))
        return false;
#endif
    float len = ls_length(ray);
    float way_in = ls_length(sub(contact, m.current));
    float way_out = ls_divide(mul(sub(len, way_in), elasticity), len);
    m.next = add(contact, mul(mirrored(ray, axis), way_out));
    m.velocity = mul(mirrored(m.velocity, axis), elasticity);
    return true;
}

bool box(int k, inout Movement m) {
    int first = 35 * k;
    vec3 scale = vec3(boxColliders[first + 32], boxColliders[first + 33], boxColliders[first + 34]);
#if BOX_KIND == BOX_KIND_AABB
    vec3 centre = vec3(boxColliders[first + 12], boxColliders[first + 13], boxColliders[first + 14]);
    vec3 box_min = sub(centre, mul(scale, 0.5)), box_max = add(centre, mul(scale, 0.5));
    vec3 lo = sub(box_min, vec3(radius)), hi = add(box_max, vec3(radius));
#if BOX_DETECT == BOX_DETECT_BOXED
    bool misses = any(lessThan(m.next, lo)) || any(greaterThan(m.next, hi));
#else
    vec3 nearest = min(max(m.next, box_min), box_max);
    bool misses = !(squared(sub(m.next, nearest)) <= mul(radius, radius));
#endif
#if SWEEP == SWEEP_OFF
    if (misses)
        return false;
#endif
    return answer(lo, hi, !misses, m);
#else
    mat4 to_world, to_local;
    for (int c = 0; c < 4; ++c)
        for (int row = 0; row < 4; ++row) {
            to_world[c][row] = boxColliders[first + 4 * c + row];
            to_local[c][row] = boxColliders[first + 16 + 4 * c + row];
        }
    vec3 rho = vec3(ls_divide(radius, scale.x), ls_divide(radius, scale.y), ls_divide(radius, scale.z));
    Movement local;
    local.next = place(to_local, m.next);
    bool misses = any(lessThan(add(local.next, rho), vec3(-0.5))) || any(greaterThan(sub(local.next, rho), vec3(0.5)));
#if SWEEP == SWEEP_OFF
    if (misses)
        return false;
#endif
    local.current = place(to_local, m.current);
    local.velocity = direction(to_local, m.velocity);
    if (!answer(sub(vec3(-0.5), rho), add(rho, vec3(0.5)), !misses, local))
        return false;
    m.next = place(to_world, local.next);
    m.velocity = direction(to_world, local.velocity);
    return true;
#endif
}

void list_of_colliders(inout Movement m) {
    bool hit = false;
    for (int k = 0; k < sphereColliderCount; ++k) {
#if ONE_HIT == ONE_HIT_ON
        if (hit)
            break;
#endif
        hit = sphere(k, m) || hit;
    }
    for (int k = 0; k < boxColliderCount; ++k) {
#if ONE_HIT == ONE_HIT_ON
        if (hit)
            break;
#endif
        hit = box(k, m) || hit;
    }
}

// A plane that the movement crosses from inside, or started beyond: then it ends on it, and nothing bounces.
void wall(inout Movement m, int axis, float limit, bool beyond, bool is_upper) {
    if (beyond) {
        m.next[axis] = limit;
#if CLAMP_VELOCITY == CLAMP_VELOCITY_ZERO
        m.velocity[axis] = is_upper ? min(m.velocity[axis], 0.0) : max(m.velocity[axis], 0.0);
#endif
        return;
    }
    vec3 ray = sub(m.next, m.current);
    vec3 n = ls_normalize(ray);
    float d = ls_divide(sub(limit, m.current[axis]), n[axis]);
    vec3 contact = add(m.current, mul(n, d));
    float len = ls_length(ray);
    float way_in = ls_length(sub(m.current, contact));
    float way_out = ls_divide(mul(sub(len, way_in), elasticity), len);
    m.next = add(contact, mul(mirrored(ray, axis), way_out));
    m.velocity = mul(mirrored(m.velocity, axis), elasticity);
}

void walls(inout Movement m) {
    vec3 lo = add(worldBoundsMin, vec3(radius));
    vec3 hi = sub(worldBoundsMax, vec3(radius));
    for (int axis = 0; axis < 3; ++axis) {
        if (m.next[axis] > hi[axis]) {
            wall(m, axis, hi[axis], m.current[axis] > hi[axis], true);
#if WALLS == WALLS_FIRST
            return;
#endif
        }
        if (m.next[axis] < lo[axis]) {
            wall(m, axis, lo[axis], m.current[axis] < lo[axis], false);
#if WALLS == WALLS_FIRST
            return;
#endif
        }
    }
}

void world(inout Movement m) {
#if WORLD == WORLD_FLOOR_CLAMP
    if (!(m.next.y > 0.0))
        m.next.y = 0.0;
#elif WORLD == WORLD_FLOOR_RADIUS
    if (!(m.next.y > radius))
        m.next.y = radius;
#elif WORLD == WORLD_FLOOR_BOUNCE
    if (m.next.y < radius)
        wall(m, 1, radius, m.current.y <= radius, false);
#elif WORLD == WORLD_BOX
    walls(m);
#endif
}
