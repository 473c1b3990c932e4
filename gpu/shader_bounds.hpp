#pragma once

namespace lockstep {

struct ShaderSource;

/// Throws Error by FILE:LINE for a text that no compiler ends within reasonable time and memory: macros that expand to
/// millions of words, arrays of billions of elements. Both branches of an #if count.
void check_bounds(const ShaderSource& stage);

} // namespace lockstep
