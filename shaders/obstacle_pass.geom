#version 330 core
#include "whole_triangle.glsl"
