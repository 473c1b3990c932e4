#version 400 core
layout(points) in;
layout(points, max_vertices = 1) out;
in vec3 VPos[]; in vec3 VVel[]; in float VMag[]; in float VTimer[];
flat out vec3 GPos; out vec3 GVel; out float GMag; out float GTimer;
void main() {
    GPos = VPos[0]; GVel = VVel[0]; GMag = VMag[0]; GTimer = VTimer[0];
    gl_Position = gl_in[0].gl_Position;
    EmitVertex();
    EndPrimitive();
}
