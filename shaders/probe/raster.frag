#version 330 core
flat in float g_Id;
out float o_Id;

void main() { o_Id = g_Id; }
