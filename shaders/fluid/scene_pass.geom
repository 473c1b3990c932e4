#version 430 core
// The pixels that a triangle may cover.
#define COVERAGE_BY_FRAGMENT
#include "arithmetic.glsl"
#include "whole_triangle.glsl"
