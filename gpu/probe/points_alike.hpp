#pragma once

namespace lockstep {

/// Whether this context's driver puts points on the same pixels, at the same depths, with a geometry stage that passes
/// them on and without one: 15,625 points whose pixel the last bits decide. Measured once a driver; leaves no
/// framebuffer bound.
bool points_alike_without_geometry();

} // namespace lockstep
