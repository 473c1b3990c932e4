// What nodes of a graph are made of. Twin: reference/system/graph_twin.hpp.

// Of NaN the second.
float smaller(float a, float b) { return a < b ? a : b; }
float greater(float a, float b) { return b < a ? a : b; }

float smoothly(float t) { return mul(mul(t, t), sub(3.0, mul(t, 2.0))); }
