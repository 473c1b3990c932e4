#pragma once
#include <cstdint>
#include <span>

#include "gpu/gl.hpp"

namespace lockstep {

/// Sets a uniform of the program in use from the words of its value, or of as many as an array has; matrices by
/// columns, `transposed`: by rows. Location -1, that of one that is not active, is no error. Returns false for other
/// types than numbers, booleans, vectors, and square matrices of floats.
bool set_uniform_words(GLint location, GLenum type, std::span<const std::uint32_t> words, bool transposed = false);

} // namespace lockstep
