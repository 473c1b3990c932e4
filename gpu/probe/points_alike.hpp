#pragma once

namespace lockstep {

/// Whether this context's driver puts points on the same pixels, at the same depths, with a geometry stage that passes
/// them on and without one: 4,096 points next to where rounding decides. Measured once a driver; leaves a framebuffer
/// of nobody's bound.
bool points_alike_without_geometry();

} // namespace lockstep
