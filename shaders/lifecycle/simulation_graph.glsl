// What an emitter's graph makes of a step: without one, nothing. The host has such a file for each that has
// (gpu/lifecycle/graphs.hpp).
void graph_motion(inout Motion m, vec3 p, vec3 v) {}
