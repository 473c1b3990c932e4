#pragma once

namespace lockstep {

/// plain: GLSL's own length, normalize, division and matrix product. exact: shaders/portable.glsl, the same bits on
/// every driver.
enum class ArithmeticSwitch { plain, exact };

} // namespace lockstep
