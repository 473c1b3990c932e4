#include <array>
#include <cstdint>

#include "gpu/check.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/texture.hpp"
#include "tests/dust/dust_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::indirect_args_test {

TEST_CASE("dust drawing: args_too_small: indirect arguments of fewer than 20 bytes are refused, and told") {
    if (!test::gl())
        return skip(test::gl().missing());
    const GlTexture color;
    allocate_texture(color.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, 1, 1);
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.id(), 0);
    const test::TemporaryFolder folder;
    folder.write("point.vert", "#version 330 core\nvoid main() { gl_Position = vec4(0.0, 0.0, 0.0, 1.0); }\n");
    folder.write("point.frag", "#version 330 core\nout vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    const Program program("point", load_stages({folder.path()}, "point", std::array{Stage::vertex, Stage::fragment}));
    program.use();
    const GlVertexArray vertices;
    gl::BindVertexArray(vertices.id());
    const GlBuffer indices, call;
    const std::array<std::uint32_t, 6> quad{0, 1, 2, 2, 1, 3};
    gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
    gl::BufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof quad, quad.data(), GL_STATIC_DRAW);
    const std::array<std::uint32_t, 5> arguments{6, 1, 0, 0, 0};
    for (const GLsizeiptr bytes : {20, 19, 16, 8}) { // 8: the two that the source fills
        gl::BindBuffer(GL_DRAW_INDIRECT_BUFFER, call.id());
        gl::BufferData(GL_DRAW_INDIRECT_BUFFER, bytes, arguments.data(), GL_STATIC_DRAW);
        gl::DrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
        INFO(bytes);
        if (bytes == 20)
            CHECK_NOTHROW(check_gl("drawing"));
        else
            CHECK_THROWS_WITH(check_gl("drawing"), Catch::Contains("GL_INVALID_OPERATION"));
    }
    gl::BindVertexArray(0);
    gl::UseProgram(0);
}

} // namespace lockstep::test::indirect_args_test
