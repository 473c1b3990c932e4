// How the emitters' graphs make a quad look: without one, as it does. The host has such a file where one has
// (gpu/lifecycle/graphs.hpp).
void graph_look(uint quad, float u, float v, inout float size, inout vec4 color) {}
