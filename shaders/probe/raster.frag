#version 330 core
// The number of a primitive. WITH_POINT_COORD: and where in a point a fragment is.
flat in float g_Id;
#ifdef WITH_POINT_COORD
out vec4 o_Id;

void main() { o_Id = vec4(gl_PointCoord, g_Id, 1.0); }
#else
out float o_Id;

void main() { o_Id = g_Id; }
#endif
