#version 330 core
// The end of collision_pass.vert where no geometry stage follows: what collision_pass.geom does. The host has the stage's
// own main() called collision_step().
#include "clip_volume.glsl"

precise flat out vec3 out_Position;
precise out vec3 out_Dir;
precise out float out_Speed;
precise out float out_CollideTime;

#undef main
void main() {
    collision_step();
    out_Position = v_Position;
    out_Dir = v_Dir;
    out_Speed = v_Speed;
    out_CollideTime = v_CollideTime;
    gl_Position = kept_position(gl_Position);
}
