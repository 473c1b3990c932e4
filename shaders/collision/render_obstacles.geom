#version 330 core
#extension GL_ARB_gpu_shader5 : require
#include "arithmetic.glsl"
#include "whole_triangle.glsl"
