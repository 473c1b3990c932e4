// What an emitter's graph makes of a birth: without one, nothing. The host has such a file for each that has
// (gpu/lifecycle/graphs.hpp).
void graph_birth(inout Birth b, uint serial, uint k, uint emitted) {}
