// A geometry stage that hands all three corners of a triangle to each of its fragments, which interpolate by themselves.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 v_Position[];

flat out vec4 g_Clip[3];
flat out vec3 g_Position[3];

void main() {
    for (int emitted = 0; emitted < 3; ++emitted) {
        for (int corner = 0; corner < 3; ++corner) {
            g_Clip[corner] = gl_in[corner].gl_Position;
            g_Position[corner] = v_Position[corner];
        }
        gl_Position = gl_in[emitted].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
