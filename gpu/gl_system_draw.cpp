#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "gpu/desktop_text.hpp"
#include "gpu/gl_system_parts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void blend_by(GlDraw::Blend blend) {
    if (blend == GlDraw::Blend::none)
        return gl::Disable(GL_BLEND);
    gl::Enable(GL_BLEND);
    blend == GlDraw::Blend::added ? gl::BlendFunc(GL_ONE, GL_ONE) : gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

} // namespace

GLuint GlSystem::Parts::sampler(GlFilter filter) const {
    const GlSampler& one = samplers.at(static_cast<std::size_t>(filter));
    const GLint wrap = filter == GlFilter::linear ? GL_CLAMP_TO_EDGE : GL_CLAMP_TO_BORDER; // the border is 0
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl::SamplerParameteri(one.id(), axis, wrap);
    for (const GLenum filters : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl::SamplerParameteri(one.id(), filters, GL_LINEAR);
    return one.id();
}

void GlSystem::Parts::lend_images(const Program& program, const GlPass& pass) const {
    std::size_t first_unit = 0;
    for (const auto& [resource, two] : images) {
        const Resource& about = schema->resources[resource];
        const auto unit = static_cast<int>(first_unit++);
        program.set_unit("u_" + shader_name(about.name) + "Before", unit, sampler_type(about));
        for (const auto& [name, target] : pass.names)
            if (target.resource == resource && target.is_sampler)
                program.set_unit(name, unit, sampler_type(about));
        gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl::BindTexture(two.front().target(), two[current[resource]].id());
        const auto filter = pass.filters.find(resource);
        gl::BindSampler(static_cast<GLuint>(unit), filter == pass.filters.end() ? 0 : sampler(filter->second));
    }
    gl::ActiveTexture(GL_TEXTURE0 + 31); // where what follows may bind as it likes
}

GlVertexArray GlSystem::Parts::inputs(const GlPass& pass, const Program& program) {
    if (!pass.instances_of)
        return vertex_array(from(first_storage(pass.resource)), program);
    std::vector<const RecordBuffer*> read;
    for (std::size_t s = 0; s < storages.size(); ++s)
        if (storages[s].layout.resource == *pass.instances_of)
            read.push_back(&from(s));
    return instance_array(read, program);
}

/// The image is drawn into what the next pass reads.
void GlSystem::Parts::draw(const Linked& linked) {
    const GlPass& pass = linked.pass;
    const GlDraw& how = *pass.draw;
    for (const std::uint8_t r : linked.resources)
        if (how.clears)
            image_to(r).clear();
        else
            image_to(r).copy(image_from(r));
    StateImage& image = image_to(pass.resource);
    const auto width = static_cast<GLsizei>(image.extent().width), height = static_cast<GLsizei>(image.extent().height);
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    std::vector<GLenum> outputs;
    for (const std::uint8_t r : linked.resources) {
        outputs.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(outputs.size()));
        gl::FramebufferTexture(GL_FRAMEBUFFER, outputs.back(), image_to(r).id(), 0);
    }
    gl::DrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
    const GlTexture depth;
    if (how.has_depth) {
        allocate_texture(depth.id(), depth32f, width, height);
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.id(), 0);
    }
    check_framebuffer(GL_FRAMEBUFFER, fmt::format("{}: image of {} x {} texels", pass.name, width, height));
    for (std::size_t i = 0; i < how.cleared_to.size(); ++i)
        gl::ClearBufferfv(GL_COLOR, static_cast<GLint>(i), glm::value_ptr(how.cleared_to[i]));
    gl::Viewport(0, 0, width, height);
    const float far_plane = 1.0F;
    if (how.has_depth) {
        gl::Enable(GL_DEPTH_TEST);
        gl::DepthFunc(GL_LESS);
        gl::DepthMask(GL_TRUE);
        gl::ClearBufferfv(GL_DEPTH, 0, &far_plane);
    }
    blend_by(how.blend);
    if (how.sized)
        gl::Enable(GL_PROGRAM_POINT_SIZE);
    const bool encodes = image.format().layout.internal == GL_SRGB8_ALPHA8;
    if (encodes)
        gl::Enable(GL_FRAMEBUFFER_SRGB);
    const RecordBuffer* const one[] = {how.once ? nullptr : &from(first_storage(how.buffer))};
    const GlVertexArray vertices = how.once           ? GlVertexArray()
                                   : how.vertices > 0 ? instance_array(one, linked.program)
                                                      : vertex_array(*one[0], linked.program);
    if (!pass.inputs.empty())
        linked.program.set(texel_size_uniform,
                           glm::vec2(1.0F / static_cast<float>(width), 1.0F / static_cast<float>(height)));
    check_given(linked);
    linked.program.use();
    gl::BindVertexArray(vertices.id());
    const GLenum primitive = how.primitive == GlDraw::Primitive::points ? GL_POINTS : GL_TRIANGLES;
    const auto items = static_cast<GLsizei>(how.once ? 1 : one[0]->size());
    ran_over = static_cast<std::uint64_t>(items) * std::max<std::size_t>(how.vertices, 1) *
               std::max<std::size_t>(how.instances, 1);
    timed([&] {
        if (how.instances > 0)
            gl::DrawArraysInstanced(primitive, 0, items, static_cast<GLsizei>(how.instances));
        else if (how.vertices > 0)
            gl::DrawArraysInstanced(primitive, 0, static_cast<GLsizei>(how.vertices), items);
        else
            gl::DrawArrays(primitive, 0, items);
    });
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_FRAMEBUFFER_SRGB, GL_PROGRAM_POINT_SIZE})
        gl::Disable(state);
    gl::BindVertexArray(0);
}

void GlSystem::Parts::capture(const Linked& linked) {
    const GlPass& pass = linked.pass;
    const std::size_t vertices = items(pass.resource), instances = pass.instances_of ? items(*pass.instances_of) : 1;
    if (instances == 0 || vertices % instances != 0)
        throw Error(fmt::format("{}: {} {} are no even share of {} instances", pass.name, vertices,
                                schema->resources[pass.resource].name, instances));
    ran_over = vertices;
    const GlVertexArray inputs_of = inputs(pass, linked.program);
    linked.program.check_interface();
    const GlQuery written;
    linked.program.use();
    gl::BindVertexArray(inputs_of.id());
    target.bind();
    to(first_storage(pass.resource)).bind_capture();
    gl::Enable(GL_RASTERIZER_DISCARD);
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
    gl::BeginTransformFeedback(GL_POINTS);
    timed([&] {
        gl::DrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(vertices / instances),
                                static_cast<GLsizei>(instances));
    });
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    gl::Disable(GL_RASTERIZER_DISCARD);
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    gl::BindVertexArray(0);
    GLuint points = 0;
    gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &points);
    if (points != vertices)
        throw Error(fmt::format("{}: transform feedback wrote {} of {} items", pass.name, points, vertices));
}

ColorImage GlSystem::Parts::picture(const Linked& linked, int frame, const GlPicture& how) {
    const GlPass& pass = linked.pass;
    const Program program(pass.name, sources(pass, std::array{Stage::vertex, Stage::fragment}, false));
    const GlTexture color;
    allocate_texture(color.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, how.width, how.height);
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.id(), 0);
    check_framebuffer(GL_FRAMEBUFFER, fmt::format("picture of {} x {} pixels", how.width, how.height));
    gl::Viewport(0, 0, how.width, how.height);
    const std::array background{static_cast<float>(how.background.r) / 255.0F,
                                static_cast<float>(how.background.g) / 255.0F,
                                static_cast<float>(how.background.b) / 255.0F, 1.0F};
    std::vector<GlPicture::Batch> batches = how.batches;
    if (batches.empty())
        batches.push_back({.count = items(pass.instances_of.value())});
    const GlTexture depth;
    const float far_plane = 1.0F;
    const bool has_depth =
        std::any_of(batches.begin(), batches.end(), [](const auto& batch) { return batch.writes_depth; });
    if (has_depth) {
        allocate_texture(depth.id(), depth32f, how.width, how.height);
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.id(), 0);
        check_framebuffer(GL_FRAMEBUFFER, "picture with depth");
        gl::Enable(GL_DEPTH_TEST);
        gl::DepthFunc(GL_LESS);
    }
    set_uniforms(program, pass, items(pass.resource), frame);
    lend_images(program, pass);
    const GlVertexArray vertices = inputs(pass, program);
    const GlBuffer indices, calls;
    std::vector<std::array<std::uint32_t, 5>> arguments;
    for (const GlPicture::Batch& batch : batches)
        arguments.push_back({static_cast<std::uint32_t>(how.indices.size()), static_cast<std::uint32_t>(batch.count), 0,
                             0, static_cast<std::uint32_t>(batch.first)});
    const auto set = [&](const GlPicture::Batch& batch) {
        for (const auto& [name, value] : batch.uniforms)
            std::visit([&, of = &name](const auto& v) { program.set(*of, v); }, value);
    };
    set(batches.front());
    program.check_interface();
    program.use();
    gl::BindVertexArray(vertices.id());
    gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
    gl::BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(how.indices.size() * sizeof(std::uint32_t)),
                   how.indices.data(), GL_STATIC_DRAW);
    gl::BindBuffer(GL_DRAW_INDIRECT_BUFFER, calls.id());
    gl::BufferData(GL_DRAW_INDIRECT_BUFFER, static_cast<GLsizeiptr>(arguments.size() * sizeof arguments[0]),
                   arguments.data(), GL_STATIC_DRAW);
    const auto clear = [&] {
        gl::DepthMask(GL_TRUE);
        gl::ClearBufferfv(GL_COLOR, 0, background.data());
        if (has_depth)
            gl::ClearBufferfv(GL_DEPTH, 0, &far_plane);
    };
    const auto draw_all = [&] {
        for (std::size_t b = 0; b < batches.size(); ++b) {
            set(batches[b]);
            blend_by(batches[b].blend);
            gl::DepthMask(batches[b].writes_depth ? GL_TRUE : GL_FALSE);
            gl::DrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                     reinterpret_cast<const void*>(b * sizeof arguments[0]));
        }
    };
    clear();
    if (takes_times) { // drivers compile what is drawn for the first time
        draw_all();
        clear();
    }
    timed(draw_all);
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST})
        gl::Disable(state);
    gl::DepthMask(GL_TRUE);
    gl::BindVertexArray(0);
    gl::UseProgram(0);
    ColorImage image(how.width, how.height);
    gl::BindTexture(GL_TEXTURE_2D, color.id());
    gl::GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.texels.data());
    check_gl(pass.name + ", picture");
    return image;
}

} // namespace lockstep
