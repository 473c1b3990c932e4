#pragma once
#include <cstddef>
#include <vector>

#include "gpu/probe.hpp"

namespace lockstep::probing {

class DriverArithmetic;

using Rows = std::vector<ProbeRow>;

// Each measures its rows in the current context and appends them. Names ending in ", precise": with the qualifier.

/// Sums, products, quotients and roots in the vertex stage, and subnormals there. `plain`: without the qualifier.
void measure_vertex_arithmetic(const DriverArithmetic& plain, const DriverArithmetic& precise, std::size_t inputs,
                               Rows& rows);

/// The same operations in the fragment stage, as far as the passes have them there.
void measure_fragment_arithmetic(Rows& rows);

/// The compute stage: what GLSL leaves open, beside the vertex stage, and subnormals in products and sums. The context
/// has one.
void measure_compute_arithmetic(const DriverArithmetic& precise, Rows& rows);

/// What GLSL leaves open, in a vertex stage that is a SPIR-V module, beside one in GLSL. The context takes modules.
void measure_module_arithmetic(const DriverArithmetic& precise, std::size_t inputs, Rows& rows);

/// Products of products in functions: whether each is rounded as it is written. In the vertex stage; in the compute
/// stage, which the context then has.
void measure_chains(const DriverArithmetic& precise, Rows& rows);
void measure_compute_chains(const DriverArithmetic& precise, Rows& rows);

/// sin, cos and tan, to which GLSL gives no precision, beside a sequence that is known of one driver.
void measure_sines(Rows& rows);
void measure_compute_sines(Rows& rows);

/// Halves and 8-bit codes, on their way into an image and out of it; texels outside it.
void measure_storage(Rows& rows);

/// Halves on their way into an image by imageStore. The context has compute shaders.
void measure_image_store(Rows& rows);

/// Sums that blending makes, GL_ONE and GL_ONE, of floats and of halves.
void measure_blending(Rows& rows);

/// GL_LINEAR in a texture of three dimensions: weights, and how they are used.
void measure_filtering(Rows& rows);

/// What GL_FRAMEBUFFER_SRGB makes of floats.
void measure_srgb(Rows& rows);

/// gl_PointCoord of points of several sizes.
void measure_point_coord(Rows& rows);

/// Points whose middle lies outside the view volume, beside the image or in depth: which are drawn.
void measure_points_outside(Rows& rows);

/// Whether floats can be added by atomics. In which order they come is another thing in each run, and no row.
void measure_atomics(Rows& rows);

/// The order in which transform feedback writes primitives.
void measure_order(Rows& rows);

/// Sub-pixel grid, rounding to it, and who owns what lies on an edge: points and triangles.
void measure_snapping(Rows& rows);

/// Perspective divide and viewport transform, with and without a geometry stage: their rounding, and whether they are
/// as accurate as a shader's own operations. Needs measure_snapping's rows, and `plain` for the driver's own 1 / w.
void measure_viewport(const DriverArithmetic& plain, Rows& rows);

/// The depth a point gets, and which of two equal ones stays.
void measure_depth(const DriverArithmetic& plain, Rows& rows);

} // namespace lockstep::probing
