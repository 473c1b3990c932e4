// The trace build (LOCKSTEP_TRACE, made by `lockstep explain`): what a stage computes on its way leaves it in outputs
// named trace_*, which transform feedback captures. In every other build TRACE is nothing.
#ifndef TRACE
#ifdef LOCKSTEP_TRACE
#define TRACE(place, value) place = value
// Of the last call of image_position.
vec4 last_clip;
vec2 last_ndc;
vec2 last_texture_coordinate;
vec2 last_image_position;
#else
#define TRACE(place, value)
#endif
#endif
