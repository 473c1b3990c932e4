// The colours of the render pass; twin of reference/collision/shading.hpp. Colours are as displayed, 0..1. Constants are binary
// fractions and sums are written out, so that a compiler has nothing to round its own way. View space: the camera at
// the origin looks down -z. Needs arithmetic.glsl and clamp_to.glsl.

const vec3 light = vec3(-0.375, 0.5, 0.78125); // of unit length within 5 / 10000

float share(float x) { return clamp_to(x, 1.0); }

float written_dot(vec3 a, vec3 b) {
    precise vec3 products = a * b;
    products = ls_flush3(products);
    return ls_add(ls_add(products.x, products.y), products.z);
}

vec3 written_cross(vec3 a, vec3 b) {
    precise vec3 products = a.yzx * b.zxy;
    precise vec3 other_products = a.zxy * b.yzx;
    precise vec3 cross_product = ls_flush3(products) - ls_flush3(other_products);
    return ls_flush3(cross_product);
}

vec3 blend(vec3 a, vec3 b, float t) {
    precise vec3 mixed = a + t * (b - a);
    return mixed;
}

vec3 background_color(int y, int height) {
    float up = ls_divide(float(2 * y + 1), float(2 * height));
    return blend(vec3(0.1875, 0.203125, 0.234375), vec3(0.046875, 0.0546875, 0.078125), up);
}

// Flat, both sides alike, lit from the upper left of the camera.
vec3 obstacle_color(vec3 corner[3]) {
    precise vec3 side = corner[1] - corner[0];
    precise vec3 other_side = corner[2] - corner[0];
    vec3 normal = written_cross(ls_flush3(side), ls_flush3(other_side));
    if (written_dot(normal, corner[0]) > 0.0)
        normal = -normal;
    float squared = written_dot(normal, normal);
    float lambert = squared > 0.0 ? ls_divide(written_dot(normal, light), ls_sqrt(squared)) : 0.0;
    precise float wrapped = 0.5 + 0.5 * lambert;
    precise float brightness = 0.125 + 0.875 * (wrapped * wrapped);
    precise vec3 color = vec3(0.8125, 0.78125, 0.734375) * brightness;
    return color;
}

// A sphere: `normal` of unit length; slow is blue, fast is white, and what has just collided glows.
vec3 particle_color(vec3 normal, float speed, float collide_time, float collision_time) {
    float fast = share(speed * 0.5);
    float heat = collide_time > 0.0 ? share(ls_divide(collide_time, collision_time)) : 0.0;
    vec3 cold = blend(vec3(0.125, 0.40625, 0.875), vec3(0.8125, 0.9375, 1.0), fast);
    vec3 color = blend(cold, vec3(1.0, 0.5, 0.09375), heat);
    float lambert = share(written_dot(normal, light));
    precise float lit = 0.3125 + 0.6875 * lambert;
    precise float glow = lit + heat * (0.5 * (1.0 - lit));
    precise float fourth = (lambert * lambert) * (lambert * lambert);
    precise float gleam = 0.25 * (fourth * fourth);
    precise vec3 shaded = color * glow + vec3(gleam);
    return shaded;
}

// To the nearest of 256 codes a channel, so that the framebuffer's own rounding has nothing left to decide.
vec4 quantised(vec3 color) {
    precise vec3 code = vec3(share(color.r), share(color.g), share(color.b)) * 255.0 + 0.5;
    return vec4(floor(code) / 255.0, 1.0);
}
