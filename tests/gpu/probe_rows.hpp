#pragma once
#include <string_view>
#include <utility>

namespace lockstep::test {

struct ExpectedRow {
    std::string_view name;
    std::string_view finding;
};

/// What llvmpipe (Mesa 22.3) computes whatever the processor and the vector width: every row of the probe but those in
/// processor_rows. The spec's table, last section, and what else the probe looks at.
inline constexpr ExpectedRow llvmpipe_rows[] = {
    {"dot(vec3)", "x+(y+z)"},
    {"x*x+y*y+z*z", "(x+y)+z"},
    {"mat4*vec4", "((x+y)+z)+w"},
    {"mat4*vec4 written out", "((x+y)+z)+w"},
    {"a*b+c", "each rounded"},
    {"x*a+x*b", "x*(a+b)"},
    {"cross", "each rounded"},
    {"fma", "rounded twice"},
    {"a/b", "rounded"},
    {"a/c, c constant", "as a/b"},
    {"a/b, b from 2^126", "rounded"},
    {"1/b", "rounded"},
    {"sqrt", "rounded"},
    {"inversesqrt", "1/sqrt(x), each rounded"},
    {"length", "sqrt(dot), rounded"},
    {"normalize", "v*(1/sqrt(dot)), rounded"},
    {"dot(vec3), precise", "x+(y+z)"},
    {"x*x+y*y+z*z, precise", "(x+y)+z"},
    {"mat4*vec4, precise", "((x+y)+z)+w"},
    {"mat4*vec4 written out, precise", "((x+y)+z)+w"},
    {"a*b+c, precise", "each rounded"},
    {"x*a+x*b, precise", "each rounded"},
    {"cross, precise", "each rounded"},
    {"fma, precise", "rounded twice"},
    {"a/b, precise", "rounded"},
    {"a/c, c constant, precise", "as a/b"},
    {"a/b, b from 2^126, precise", "rounded"},
    {"1/b, precise", "rounded"},
    {"sqrt, precise", "rounded"},
    {"inversesqrt, precise", "1/sqrt(x), each rounded"},
    {"length, precise", "sqrt(dot), rounded"},
    {"normalize, precise", "v*(1/sqrt(dot)), rounded"},
    {"subnormal operand of *", "flushed"},
    {"subnormal result of *", "flushed"},
    {"subnormal operand of +", "flushed"},
    {"subnormal result of +", "flushed"},
    {"subnormal passed on", "kept"},
    {"subnormal > 0", "flushed"},
    {"fragment a/b", "rounded"},
    {"fragment 1/b", "rounded"},
    {"fragment sqrt", "rounded"},
    {"fragment inversesqrt", "1/sqrt(x), each rounded"},
    {"fragment dot(vec3)", "x+(y+z)"},
    {"fragment length", "sqrt(x+(y+z)), rounded"},
    {"fragment a*b+c", "each rounded"},
    {"fragment a*b+c, precise", "each rounded"},
    {"module: dot(vec3)", "as in GLSL"},
    {"module: length", "as in GLSL"},
    {"module: normalize", "v/sqrt(x+(y+z)), rounded"},
    {"compute: a/b", "as in the vertex stage"},
    {"compute: a/c, c constant", "as a/b"},
    {"compute: 1/b", "as in the vertex stage"},
    {"compute: sqrt", "as in the vertex stage"},
    {"compute: inversesqrt", "as in the vertex stage"},
    {"compute: dot(vec3)", "as in the vertex stage"},
    {"compute: length", "as in the vertex stage"},
    {"compute: normalize", "as in the vertex stage"},
    {"compute: a*b+c, in functions", "each rounded"},
    {"compute: c-a*b, in functions", "each rounded"},
    {"v*s*t, in functions", "as written"},
    {"v*s/t, in functions", "as written"},
    {"v/s*t, in functions", "as written"},
    {"compute: v*s*t, in functions", "as written"},
    {"compute: v*s/t, in functions", "as written"},
    {"compute: v/s*t, in functions", "as written"},
    {"compute: subnormal operand of *", "kept"},
    {"compute: subnormal result of *", "kept"},
    {"compute: subnormal operand of +", "kept"},
    {"compute: subnormal result of +", "kept"},
    {"compute: subnormal < 0", "kept"},
    {"float to half", "truncate"},
    {"float to subnormal half", "truncate"},
    {"float above the largest half", "largest"},
    {"float to unorm8", "rint(x*255)"},
    {"unorm8 to float", "c*(1/255)"},
    {"half to float", "exact"},
    {"texelFetch outside", "zero"},
    {"image: store to half", "truncate"},
    {"image: store to subnormal half", "truncate"},
    {"image: store above the largest half", "largest"},
    {"image: blend rgba32f", "each sum rounded, in order"},
    {"image: blend rgba16f", "each sum truncated"},
    {"image: linear filter, weights", "all bits"},
    {"image: linear filter, aligned", "none known"},
    {"image: linear filter, aligned, border of 0", "none known"},
    {"image: linear filter of a plane, aligned", "none known"},
    {"image: sRGB store", "none known"},
    {"image: sRGB store, accuracy", "one of the two next codes"},
    {"image: gl_PointCoord", "none known"},
    {"image: gl_PointCoord, accuracy", "to 1/256 pixel, from above"},
    {"image: gl_PointCoord, cut size", "none known"},
    {"image: points outside, dropped", "all, as GL says"},
    {"image: points beside the image, drawn", "none known"},
    {"image: points just outside, dropped", "all, as GL says"},
    {"image: points just outside, drawn", "none known"},
    {"image: float atomics", "offered"},
    {"transform feedback order", "as drawn"},
    {"points: edge in x", "lower pixel"},
    {"points: edge in y", "lower pixel"},
    {"points: sub-pixel bits", "8"},
    {"points: snap", "half away from zero"},
    {"triangles: left side", "in"},
    {"triangles: right side", "out"},
    {"triangles: lower side", "in"},
    {"triangles: upper side", "out"},
    {"triangles: sub-pixel bits", "8"},
    {"triangles: snap", "half to even"},
    {"points: viewport", "(clip*(1/w))*scale + offset"},
    {"triangles: viewport", "(clip*(1/w))*scale + offset"},
    {"points: window accuracy", "as GLSL's"},
    {"triangles: window accuracy", "as GLSL's"},
    {"points: depth", "(clip*(1/w))*0.5 + 0.5"},
    {"points: depth, no geometry stage", "(clip*(1/w))*0.5 + 0.5"},
    {"equal depth, LESS", "first stays"},
    {"equal depth, LEQUAL", "last wins"},
};

/// What a later llvmpipe computes otherwise; in releases between the two measured ones it may be either.
struct LaterRow {
    std::string_view name;
    std::string_view finding;
    int last_without; ///< Mesa's release
    int first_with;
    bool is_fused = false; ///< only on a processor with fused multiply-add
};

inline constexpr LaterRow later_rows[] = {
    {"dot(vec3), precise", "(x+y)+z", 22, 25},
    {"module: dot(vec3)", "x+(y+z)", 22, 25},
    {"module: length", "sqrt(x+(y+z)), rounded", 22, 25},
    {"points: snap", "half to even", 22, 25},
    {"fma", "rounded once", 25, 26, true},
    {"fma, precise", "rounded once", 25, 26, true},
    {"compute: subnormal result of *", "flushed", 25, 26},
    {"compute: subnormal result of +", "flushed", 25, 26},
};

/// Rows that depend on the processor: with fused multiply-add, or without.
struct ProcessorRow {
    std::string_view name;
    std::string_view fused;
    std::string_view separate;
};

inline constexpr ProcessorRow processor_rows[] = {
    {"points: viewport, no geometry stage", "fma(clip*(1/w), scale, offset)", "(clip*(1/w))*scale + offset"},
    {"triangles: viewport, no geometry stage", "fma(clip*(1/w), scale, offset)", "(clip*(1/w))*scale + offset"},
    {"image: linear filter", "fma(f, b - a, a), all bits", "a + f*(b - a), all bits"},
    {"image: linear filter, border of 0", "fma(f, b - a, a), all bits", "a + f*(b - a), all bits"},
    {"image: linear filter of a plane", "fma(f, b - a, a), all bits", "a + f*(b - a), all bits"},
    {"sin, to 32768", "polynomial, fused", "polynomial, each rounded"},
    {"cos, to 1024", "polynomial, fused", "polynomial, each rounded"},
    {"tan, to 1024", "polynomial, fused", "polynomial, each rounded"},
    {"compute: sin, to 32768", "polynomial, fused", "polynomial, each rounded"},
    {"compute: cos, to 1024", "polynomial, fused", "polynomial, each rounded"},
    {"compute: tan, to 1024", "polynomial, fused", "polynomial, each rounded"},
    {"sin", "none known", "none known"},
    {"exp2", "none known", "none known"},
    {"pow(x,2.2)", "none known", "none known"},
};

} // namespace lockstep::test
