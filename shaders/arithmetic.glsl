// The operations GLSL leaves open, under one set of names. The switch `arithmetic` picks: the driver's own, or
// sequences that give the same bits on every driver. A stage file includes this and calls ls_*; it has
// `#extension GL_ARB_gpu_shader5 : require` at its top, for `precise`.
#if ARITHMETIC == ARITHMETIC_EXACT
#include "portable.glsl"
#else
#include "plain.glsl"
#endif
