#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/gl.hpp"
#include "reference/text/memory.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// The program in use.
GLuint current_program();

/// The words of what GL has bound to a storage or uniform block of a program; one word where the block is not active.
std::vector<std::uint32_t> words_of_block(GLuint program, const text::Block& block);

/// The value of a plain uniform of a program; empty where it is not active.
std::vector<std::uint32_t> words_of_uniform(GLuint program, const text::PlainUniform& uniform);

/// The texels of level 0 of what GL has bound to a sampler, of two or three dimensions or an array of layers. Throws
/// Error for another.
struct BoundTexels {
    text::TexelMemory memory; ///< without its words
    std::vector<std::uint32_t> words;
};
BoundTexels texels_of(GLuint program, const text::ImageUniform& image);

/// Sets every uniform of a program to what another has, and binds its storage blocks to the same; those that the other
/// has not go to `binding`.
void copy_bindings(GLuint from, GLuint to, GLuint binding);

} // namespace lockstep
