#version 430 core
// The pixels that a triangle may cover.
#include "covering.glsl"
