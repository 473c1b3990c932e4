// Hands the whole triangle to all pixels that it may cover; their fragments decide which it does.
#include "arithmetic.glsl"
#include "pixel_box.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

in vec3 v_Position[];
in vec3 v_Albedo[];

precise flat out vec4 g_Clip[3];
precise flat out vec3 g_Position[3];
precise flat out vec3 g_Albedo;

void main() {
    ivec4 box = triangle_box(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
    if (is_empty(box))
        return;
    for (int i = 0; i < 4; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            g_Clip[corner] = gl_in[corner].gl_Position;
            g_Position[corner] = v_Position[corner];
        }
        g_Albedo = v_Albedo[0];
        gl_Position = box_corner(box, i);
        EmitVertex();
    }
    EndPrimitive();
}
