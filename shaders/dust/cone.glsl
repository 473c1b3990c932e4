// The vacuum's cone. Twin: reference/dust/cone.hpp.

uniform vec3 controllerPos, controllerForward;
uniform float cleanerSqrForce, cleanerSqrDist, cleanerDotThreshold, cleanerSqrDeathRange;

// False where the cone does not have the grain.
bool suction_force(vec3 position, out vec3 force) {
    force = vec3(0.0);
    vec3 way = sub(controllerPos, position);
    float d2 = squared(way);
    if (!(d2 < cleanerSqrDist))
        return false;
#if SAFE_DIRECTION == SAFE_DIRECTION_ON || ARITHMETIC == ARITHMETIC_EXACT
    if (!(d2 > 0.0)) // NaN below is beside no cone, but an H200 has it inside
        return false;
#endif
    vec3 n = ls_normalize(way);
    float k = ls_dot(controllerForward, neg(n));
    if (!(k > cleanerDotThreshold))
        return false;
    force = mul(mul(n, ls_divide(cleanerSqrForce, d2)), k);
    return true;
}

// Whether a grain that was pulled is in the mouth, or out of the cone, at `next`.
bool kills(vec3 position, vec3 next) {
    vec3 b = ls_normalize(neg(sub(controllerPos, position)));
    vec3 away = sub(next, controllerPos);
    vec3 c = ls_normalize(away);
    if (!(ls_dot(controllerForward, b) > cleanerDotThreshold))
        return false;
    float along = ls_dot(controllerForward, c);
#if SIDE_EXIT == SIDE_EXIT_KEEP
    return along < 0.0 || squared(away) < cleanerSqrDeathRange;
#else
    return along < cleanerDotThreshold || squared(away) < cleanerSqrDeathRange;
#endif
}
