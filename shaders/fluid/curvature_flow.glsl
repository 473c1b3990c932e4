// A step of curvature flow (van der Laan, Green and Sainz, "Screen space fluid rendering with curvature flow", 2009): the
// surface moves along the view by its mean curvature. Needs working.glsl.

uniform vec2 u_FlowScale; // Cx, Cy
uniform float u_FlowStep;
uniform float u_FlowReach; // m, how far from the centre a neighbour may be

// Whether a neighbour belongs to the surface; its view depth.
bool joins(ivec2 pixel, ivec2 offset, float centre, out float z) {
    z = centre;
    float stored = stored_at(pixel, offset);
    if (!is_inside(pixel + offset) || is_nothing(stored))
        return false;
    z = z_of(stored);
    return abs(sub(z, centre)) <= u_FlowReach;
}

float filtered(ivec2 pixel, float z) {
    float east, west, north, south;
    bool has_east = joins(pixel, ivec2(1, 0), z, east);
    bool has_west = joins(pixel, ivec2(-1, 0), z, west);
    bool has_north = joins(pixel, ivec2(0, 1), z, north);
    bool has_south = joins(pixel, ivec2(0, -1), z, south);
    float zx = 0.0, zxx = 0.0, zy = 0.0, zyy = 0.0, zxy = 0.0;
    if (has_east && has_west) {
        zx = mul(sub(east, west), 0.5);
        zxx = sub(add(east, west), add(z, z));
    }
    if (has_north && has_south) {
        zy = mul(sub(north, south), 0.5);
        zyy = sub(add(north, south), add(z, z));
    }
    float pp, mp, pm, mm; // signs of x and y
    bool has_pp = joins(pixel, ivec2(1, 1), z, pp);
    bool has_mp = joins(pixel, ivec2(-1, 1), z, mp);
    bool has_pm = joins(pixel, ivec2(1, -1), z, pm);
    bool has_mm = joins(pixel, ivec2(-1, -1), z, mm);
    if (has_pp && has_mp && has_pm && has_mm)
        zxy = mul(sub(sub(pp, mp), sub(pm, mm)), 0.25);

    float cx = u_FlowScale.x, cy = u_FlowScale.y;
    float cx2 = mul(cx, cx);
    float cy2 = mul(cy, cy);
    float c = mul(cx2, cy2);
    float e = add(add(mul(cy2, mul(zx, zx)), mul(cx2, mul(zy, zy))), mul(c, mul(z, z)));
    float fx = mul(2.0, add(add(mul(cy2, mul(zx, zxx)), mul(cx2, mul(zy, zxy))), mul(c, mul(z, zx))));
    float fy = mul(2.0, add(add(mul(cy2, mul(zx, zxy)), mul(cx2, mul(zy, zyy))), mul(c, mul(z, zy))));
    float ex = sub(mul(mul(zx, fx), 0.5), mul(zxx, e));
    float ey = sub(mul(mul(zy, fy), 0.5), mul(zyy, e));
    float curvature = ls_divide(add(mul(cy, ex), mul(cx, ey)), mul(mul(2.0, e), ls_sqrt(e)));
    return sub(z, mul(curvature, u_FlowStep));
}
