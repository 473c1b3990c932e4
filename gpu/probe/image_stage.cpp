#include "gpu/probe/image_stage.hpp"

#include "gpu/check.hpp"

namespace lockstep::probing {
namespace {

Program link_image_stage(const std::string& fragment_shader) {
    const ShaderFolders folders = shader_folders();
    const ShaderSource stages[] = {load_stage(folders, "probe/image", Stage::vertex),
                                   load_stage(folders, fragment_shader, Stage::fragment)};
    return {fragment_shader, stages};
}

} // namespace

ImageStage::ImageStage(const std::string& fragment_shader) : program_(link_image_stage(fragment_shader)) {}

void ImageStage::run(int width, int height, std::span<const GlTexture* const> sources,
                     std::span<const GlTexture* const> targets) const {
    const GlFramebuffer framebuffer = make_framebuffer(targets);
    gl::Viewport(0, 0, width, height);
    gl::Disable(GL_DEPTH_TEST);
    const char* names[] = {"u_A", "u_B"};
    for (std::size_t i = 0; i < sources.size(); ++i) {
        program_.set_unit(names[i], static_cast<int>(i));
        gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        gl::BindTexture(GL_TEXTURE_2D, sources[i]->id());
    }
    gl::ActiveTexture(GL_TEXTURE0);
    program_.use();
    const GlVertexArray array;
    gl::BindVertexArray(array.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    gl::BindVertexArray(0);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl(program_.name());
}

} // namespace lockstep::probing
