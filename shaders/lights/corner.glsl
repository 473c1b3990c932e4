// A corner of an obstacle.
#include "arithmetic.glsl"

in vec3 a_CornerPosition;
in vec3 a_CornerAlbedo;

uniform mat4 u_ProjView;

precise out vec3 v_Position;
precise out vec3 v_Albedo;
precise gl_Position;

void main() {
    v_Position = ls_flush3(a_CornerPosition);
    v_Albedo = ls_flush3(a_CornerAlbedo);
    gl_Position = ls_transform(u_ProjView, a_CornerPosition);
}
