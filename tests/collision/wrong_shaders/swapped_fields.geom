#version 400 core
// cause: speed_and_collide_time_swapped, in crowd
layout(points) in;
layout(points, max_vertices = 1) out;
in vec3 v_Position[1];
in vec3 v_Dir[1];
in float v_Speed[1];
in float v_CollideTime[1];
flat out vec3 out_Position;
out vec3 out_Dir;
out float out_Speed;
out float out_CollideTime;
void main() {
    const int first = 0;
    gl_Position = gl_in[first].gl_Position;
    out_CollideTime = v_Speed[first];
    out_Speed = v_CollideTime[first];
    out_Dir = v_Dir[first];
    out_Position = v_Position[first];
    EmitVertex();
}
