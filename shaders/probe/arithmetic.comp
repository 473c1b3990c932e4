#version 430 core
// What GLSL leaves open, each operation `precise`, and products that another function adds to: one input an invocation.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Inputs { float inputs[]; };    // two vec3 each
layout(std430, binding = 1) writeonly buffer Results { float results[]; }; // fifteen each

float product(float a, float b) {
    precise float p = a * b;
    return p;
}

float sum(float a, float b) {
    precise float s = a + b;
    return s;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec3 a = vec3(inputs[6u * i], inputs[6u * i + 1u], inputs[6u * i + 2u]);
    vec3 b = vec3(inputs[6u * i + 3u], inputs[6u * i + 4u], inputs[6u * i + 5u]);
    precise float quotient = a.x / b.x;
    precise float reciprocal = 1.0 / b.y;
    precise float root = sqrt(abs(a.y));
    precise float inverse = inversesqrt(abs(a.z));
    precise float dotted = dot(a, b);
    precise float len = length(b);
    precise vec3 unit = normalize(a);
    precise float thousandths = a.x / 79238.288;
    precise float thirds = a.y / 3.0;
    precise float codes = a.z / 255.0;
    precise float seeds = b.x / 82801.277;
    float written[15] = float[15](quotient, reciprocal, root, inverse, dotted, len, unit.x, unit.y, unit.z,
                                  sum(product(a.x, a.y), a.z), sum(b.z, -product(b.x, b.y)),
                                  thousandths, thirds, codes, seeds);
    for (uint k = 0u; k < 15u; ++k)
        results[15u * i + k] = written[k];
}
