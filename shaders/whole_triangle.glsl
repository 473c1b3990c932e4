// A geometry stage that hands all three corners of a triangle to each of its fragments, which interpolate by themselves.
// In the exact preset, or where COVERAGE_BY_FRAGMENT is defined, they also decide by themselves which of them the triangle
// covers (triangle_interpolation.glsl): the stage then draws all pixels that may be. Needs arithmetic.glsl.
#if ARITHMETIC == ARITHMETIC_EXACT || defined(COVERAGE_BY_FRAGMENT)
#include "pixel_box.glsl"
#endif

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

in vec3 v_Position[];

precise flat out vec4 g_Clip[3];
precise flat out vec3 g_Position[3];
precise gl_Position;

void emit_corner(vec4 position) {
    for (int corner = 0; corner < 3; ++corner) {
        g_Clip[corner] = gl_in[corner].gl_Position;
        g_Position[corner] = v_Position[corner];
    }
    gl_Position = position;
    EmitVertex();
}

#if ARITHMETIC == ARITHMETIC_EXACT || defined(COVERAGE_BY_FRAGMENT)

void main() {
    ivec4 box = triangle_box(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
    if (is_empty(box))
        return;
    for (int i = 0; i < 4; ++i)
        emit_corner(box_corner(box, i));
    EndPrimitive();
}

#else

void main() {
    for (int corner = 0; corner < 3; ++corner)
        emit_corner(gl_in[corner].gl_Position);
    EndPrimitive();
}

#endif
