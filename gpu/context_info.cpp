#include "gpu/context_info.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gpu/gl.hpp"

namespace lockstep {
namespace {

std::string text(GLenum name) {
    const GLubyte* value = gl::GetString(name);
    return value != nullptr ? reinterpret_cast<const char*>(value) : "";
}

int integer(GLenum name) {
    GLint value = 0;
    gl::GetIntegerv(name, &value);
    return value;
}

/// Calls `visit(name, member)` for every field.
template <class Info, class Visit> void for_each_field(Info& info, const Visit& visit) {
    visit("backend", info.backend);
    visit("vendor", info.vendor);
    visit("renderer", info.renderer);
    visit("version", info.version);
    visit("glsl", info.glsl);
    visit("major", info.major);
    visit("minor", info.minor);
    visit("precise", info.precise);
    visit("clip_control", info.clip_control);
    visit("compute", info.compute);
    visit("subpixel_bits", info.subpixel_bits);
    visit("max_texture_size", info.max_texture_size);
    visit("max_viewport_width", info.max_viewport_width);
    visit("max_viewport_height", info.max_viewport_height);
    visit("max_xfb_interleaved_components", info.max_xfb_interleaved_components);
    visit("max_vertex_uniform_components", info.max_vertex_uniform_components);
    visit("max_geometry_uniform_components", info.max_geometry_uniform_components);
    visit("max_fragment_uniform_components", info.max_fragment_uniform_components);
    visit("max_geometry_output_vertices", info.max_geometry_output_vertices);
    visit("max_texture_units", info.max_texture_units);
    visit("min_point_size", info.min_point_size);
    visit("max_point_size", info.max_point_size);
    visit("timer_bits", info.timer_bits);
    visit("max_ssbo_bytes", info.max_ssbo_bytes);
}

} // namespace

ContextInfo query_context_info(std::string backend) {
    ContextInfo info;
    info.backend = std::move(backend);
    info.vendor = text(GL_VENDOR);
    info.renderer = text(GL_RENDERER);
    info.version = text(GL_VERSION);
    info.glsl = text(GL_SHADING_LANGUAGE_VERSION);
    info.major = integer(GL_MAJOR_VERSION);
    info.minor = integer(GL_MINOR_VERSION);
    info.precise = gl::offers(4, 0, "GL_ARB_gpu_shader5");
    info.clip_control = gl::ClipControl != nullptr;
    info.compute = gl::offers(4, 3);
    info.subpixel_bits = integer(GL_SUBPIXEL_BITS);
    info.max_texture_size = integer(GL_MAX_TEXTURE_SIZE);
    GLint viewport[2] = {0, 0};
    gl::GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    info.max_viewport_width = viewport[0];
    info.max_viewport_height = viewport[1];
    info.max_xfb_interleaved_components = integer(GL_MAX_TRANSFORM_FEEDBACK_INTERLEAVED_COMPONENTS);
    info.max_vertex_uniform_components = integer(GL_MAX_VERTEX_UNIFORM_COMPONENTS);
    info.max_geometry_uniform_components = integer(GL_MAX_GEOMETRY_UNIFORM_COMPONENTS);
    info.max_fragment_uniform_components = integer(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS);
    info.max_geometry_output_vertices = integer(GL_MAX_GEOMETRY_OUTPUT_VERTICES);
    info.max_texture_units = integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    GLfloat points[2] = {0.0F, 0.0F};
    gl::GetFloatv(GL_POINT_SIZE_RANGE, points);
    info.min_point_size = points[0];
    info.max_point_size = points[1];
    gl::GetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &info.timer_bits);
    if (info.compute) {
        GLint64 bytes = 0;
        gl::GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
        info.max_ssbo_bytes = bytes;
    }
    return info;
}

std::string summary(const ContextInfo& info) {
    return fmt::format("{}; {}; {}", info.renderer, info.version, info.backend);
}

void to_json(nlohmann::json& json, const ContextInfo& info) {
    for_each_field(info, [&](const char* name, const auto& value) { json[name] = value; });
}

void from_json(const nlohmann::json& json, ContextInfo& info) {
    for_each_field(info, [&](const char* name, auto& value) { json.at(name).get_to(value); });
}

} // namespace lockstep
