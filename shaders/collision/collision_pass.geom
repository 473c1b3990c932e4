#version 330 core
// Passes each particle on; transform feedback captures the four outputs in the order out_Position, out_Speed,
// out_Dir, out_CollideTime.
#include "clip_volume.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;

in vec3 v_Position[];
in vec3 v_Dir[];
in float v_Speed[];
in float v_CollideTime[];

flat out vec3 out_Position; // flat: an interpolated copy differs in half of the texels
out vec3 out_Dir;
out float out_Speed;
out float out_CollideTime;

void main() {
    out_Position = v_Position[0];
    out_Dir = v_Dir[0];
    out_Speed = v_Speed[0];
    out_CollideTime = v_CollideTime[0];
    gl_Position = kept_position(gl_in[0].gl_Position);
    EmitVertex();
    EndPrimitive();
}
