#version 330 core
// A position in clip space and the number of its primitive. WITH_GEOMETRY: a geometry stage passes them on.
// WITH_POINT_SIZE: the size is set here.
#ifdef WITH_GEOMETRY
#define g_Id v_Id
#endif
in vec4 a_Clip;
in float a_Id;
flat out float g_Id;
#ifdef WITH_POINT_SIZE
uniform float u_PointSize; // pixels
#endif

void main() {
    g_Id = a_Id;
    gl_Position = a_Clip;
#ifdef WITH_POINT_SIZE
    gl_PointSize = u_PointSize;
#endif
}
