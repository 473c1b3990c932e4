#version 430 core
// Evaluates a graph of nodes for each item. The two files that no folder has are made from the graph: what an item has
// before and after, and the statements. Twin: reference/system/graph_twin.hpp.

#include "rounding.glsl"
#include "graph_nodes.glsl"
#include "graph_words.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer InputWords { Inputs inputs[]; };
layout(std430) buffer OutputWords { Outputs outputs[]; };

uniform uint u_ItemCount;
uniform uint u_Seed; // of random numbers

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_ItemCount)
        return;
#include "graph_statements.glsl"
}
