#version 330 core
// cause: none, in origin
#extension GL_ARB_gpu_shader5 : require
layout(points) in;
layout(points, max_vertices = 1) out;
in vec3 v_Position[];
in vec3 v_Dir[];
in float v_Speed[];
in float v_CollideTime[];
flat out vec3 out_Position;
out vec3 out_Dir;
out float out_Speed;
out float out_CollideTime;

bool inside(vec4 c) {
    if (!(c.w >= 1.17549435e-38 && c.w <= 3.402823466e38)) return false;
    vec3 m = abs(c.xyz);
    return m.x <= c.w && m.y <= c.w && m.z <= c.w;
}
void main() {
    out_CollideTime = v_CollideTime[0];
    out_Speed = v_Speed[0];
    out_Dir = v_Dir[0];
    out_Position = v_Position[0];
    vec4 c = gl_in[0].gl_Position;
    if (out_CollideTime >= 0.0) c = vec4(0.0, 0.0, 2.0, 1.0);
    if (!inside(c)) c = vec4(0.0, 0.0, 2.0, 1.0);
    
    gl_Position = c;
    EmitVertex();
    EndPrimitive();
}
