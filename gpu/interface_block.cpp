#include "gpu/interface_block.hpp"

#include <array>
#include <cstddef>

namespace lockstep {
namespace {

std::string resource_name(GLuint program, GLenum interface, GLuint index) {
    std::array<char, 512> name{};
    gl::GetProgramResourceName(program, interface, index, static_cast<GLsizei>(name.size()), nullptr, name.data());
    return name.data();
}

template <std::size_t count> std::array<GLint, count> resource(GLuint program, GLenum interface, GLuint index,
                                                               const std::array<GLenum, count>& properties) {
    std::array<GLint, count> values{};
    gl::GetProgramResourceiv(program, interface, index, static_cast<GLsizei>(count), properties.data(),
                             static_cast<GLsizei>(count), nullptr, values.data());
    return values;
}

BlockMember buffer_variable(GLuint program, GLuint variable) {
    const auto [type, offset, size, step, matrix, row_major, items, stride] =
        resource(program, GL_BUFFER_VARIABLE, variable,
                 std::array<GLenum, 8>{GL_TYPE, GL_OFFSET, GL_ARRAY_SIZE, GL_ARRAY_STRIDE, GL_MATRIX_STRIDE,
                                       GL_IS_ROW_MAJOR, GL_TOP_LEVEL_ARRAY_SIZE, GL_TOP_LEVEL_ARRAY_STRIDE});
    return {resource_name(program, GL_BUFFER_VARIABLE, variable),
            static_cast<GLenum>(type),
            offset,
            size,
            step,
            matrix,
            row_major != 0,
            items,
            stride};
}

} // namespace

GLuint storage_block_count(GLuint program) {
    GLint count = 0;
    gl::GetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    return static_cast<GLuint>(count);
}

GLint storage_binding(GLuint program, GLuint block) {
    return resource(program, GL_SHADER_STORAGE_BLOCK, block, std::array<GLenum, 1>{GL_BUFFER_BINDING})[0];
}

std::vector<InterfaceBlock> linked_storage_blocks(GLuint program) {
    std::vector<InterfaceBlock> blocks(storage_block_count(program));
    for (GLuint b = 0; b < static_cast<GLuint>(blocks.size()); ++b) {
        const auto [binding, bytes, count] =
            resource(program, GL_SHADER_STORAGE_BLOCK, b,
                     std::array<GLenum, 3>{GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE, GL_NUM_ACTIVE_VARIABLES});
        blocks[b] = {resource_name(program, GL_SHADER_STORAGE_BLOCK, b), binding, bytes};
        std::vector<GLint> variables(static_cast<std::size_t>(count));
        const GLenum all = GL_ACTIVE_VARIABLES;
        gl::GetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, b, 1, &all, count, nullptr, variables.data());
        for (const GLint variable : variables)
            blocks[b].members.push_back(buffer_variable(program, static_cast<GLuint>(variable)));
    }
    return blocks;
}

} // namespace lockstep
