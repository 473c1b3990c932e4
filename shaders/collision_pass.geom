#version 330 core
// Passes each particle on; transform feedback captures the four outputs in the order out_Position, out_Speed,
// out_Dir, out_CollideTime.
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

// GL discards a point whose centre lies outside the clip volume (4.5, 13.5). A driver with a guard band may let it
// pass, and NaN decides differently everywhere, so the rule is written out. At w = 0 a point has no place on the image.
bool in_clip_volume(vec4 clip) {
    return clip.w > 0.0 && abs(clip.x) <= clip.w && abs(clip.y) <= clip.w && abs(clip.z) <= clip.w;
}

void main() {
    out_Position = v_Position[0];
    out_Dir = v_Dir[0];
    out_Speed = v_Speed[0];
    out_CollideTime = v_CollideTime[0];
    gl_Position = in_clip_volume(gl_in[0].gl_Position) ? gl_in[0].gl_Position : vec4(0.0, 0.0, 2.0, 1.0);
    EmitVertex();
    EndPrimitive();
}
