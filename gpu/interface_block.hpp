#pragma once
#include <string>
#include <vector>

#include "gpu/gl.hpp"

namespace lockstep {

/// A number, vector or matrix in a block, as the interfaces GL_UNIFORM and GL_BUFFER_VARIABLE have it. In bytes.
struct BlockMember {
    std::string name; ///< "particles[0].place"
    GLenum type = 0;
    GLint offset = 0;
    GLint size = 1; ///< elements of an array; 0: it has no size
    GLint array_stride = 0, matrix_stride = 0;
    bool row_major = false;
    GLint top_level_size = 1, top_level_stride = 0; ///< of the array of structures, or of arrays, that it lies in
};

/// A uniform or storage block of a program.
struct InterfaceBlock {
    std::string name;
    GLint binding = 0, bytes = 0;
    std::vector<BlockMember> members = {};
};

/// The active storage blocks of a linked program, in GL's order, with the active variables of each. Needs GL 4.3.
std::vector<InterfaceBlock> linked_storage_blocks(GLuint program);

/// How many there are, and the binding point that one has now.
GLuint storage_block_count(GLuint program);
GLint storage_binding(GLuint program, GLuint block);

} // namespace lockstep
