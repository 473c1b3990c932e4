#version 430 core
// An obstacle's corner, into clip space.
#include "corner.glsl"
