#include "gpu/program_linking.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/shader_log.hpp"
#include "gpu/stage_texts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::string link_log(GLuint program) {
    GLint length = 0;
    gl::GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl::GetProgramInfoLog(program, length, nullptr, log.data());
    return log;
}

} // namespace

bool link(GLuint program, std::span<const Capture> captured) {
    std::vector<const char*> names;
    for (const Capture& capture : captured)
        names.push_back(capture.name.c_str());
    gl::TransformFeedbackVaryings(program, static_cast<GLsizei>(names.size()), names.data(), GL_INTERLEAVED_ATTRIBS);
    gl::LinkProgram(program);
    GLint linked = GL_FALSE;
    gl::GetProgramiv(program, GL_LINK_STATUS, &linked);
    return linked == GL_TRUE;
}

void note_link_warnings(GLuint program, std::span<const ShaderSource> stages) {
    note_shader_warnings(link_warnings(link_log(program), stages));
}

std::vector<Capture> accepted_spellings(GLuint program, std::span<const ShaderSource> stages,
                                        std::span<const Capture> captured) {
    const ShaderSource* const last = last_vertex_stage(stages);
    const auto names = [&](const Capture& capture) { return spellings(last->text, capture.name); };
    if (last == nullptr || std::ranges::all_of(captured, [&](const Capture& one) { return names(one).size() == 1; }))
        return {};
    std::vector<Capture> accepted;
    for (const Capture& capture : captured)
        for (const std::string& name : names(capture))
            if (const Capture one{name, capture.type, capture.size}; link(program, {&one, 1})) {
                accepted.push_back(one);
                break;
            }
    if (accepted.size() == captured.size() && link(program, accepted))
        return accepted;
    link(program, captured); // its log is what is reported
    return {};
}

std::string link_failure(GLuint program, std::span<const ShaderSource> stages, std::span<const Capture> captured) {
    const std::string reason = first_link_error(link_log(program));
    if (const std::string flat = missing_flat(stages); !flat.empty())
        return flat;
    if (!captured.empty() && link(program, {}))
        for (const Capture& capture : captured)
            if (!link(program, {&capture, 1}))
                return fmt::format(
                    "output {} is not written by the last vertex-processing stage ({}); it must write {}", capture.name,
                    last_vertex_stage_file(stages), joined_names(captured));
    std::vector<std::string_view> files;
    for (const ShaderSource& stage : stages)
        files.emplace_back(stage.files.front());
    return fmt::format("does not link ({}): {}", fmt::join(files, ", "), reason);
}

std::string joined_names(std::span<const Capture> captured) {
    std::vector<std::string_view> names;
    for (const Capture& capture : captured)
        names.emplace_back(capture.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

void add_attribute(ProgramVariable variable, const Bindings* bindings, ProgramInterface& attributes) {
    if (bindings != nullptr)
        if (const auto bound = bindings->attributes.find(variable.name); bound != bindings->attributes.end())
            return attributes.add(std::move(variable), bound->second);
    attributes.add(std::move(variable));
}

void check_geometry_stage(GLuint program, std::span<const ShaderSource> stages) {
    const auto stage = std::find_if(stages.begin(), stages.end(),
                                    [](const ShaderSource& source) { return source.stage == Stage::geometry; });
    if (stage == stages.end())
        return;
    const auto name = [](GLint primitive) {
        switch (static_cast<GLenum>(primitive)) {
        case GL_LINES:
            return "lines";
        case GL_LINES_ADJACENCY:
            return "lines_adjacency";
        case GL_TRIANGLES_ADJACENCY:
            return "triangles_adjacency";
        case GL_LINE_STRIP:
            return "line_strip";
        case GL_TRIANGLE_STRIP:
            return "triangle_strip";
        default:
            return "triangles";
        }
    };
    for (const auto& [what, direction] : {std::pair{GL_GEOMETRY_INPUT_TYPE, "in"}, {GL_GEOMETRY_OUTPUT_TYPE, "out"}}) {
        GLint primitive = GL_POINTS;
        gl::GetProgramiv(program, what, &primitive);
        if (primitive != GL_POINTS)
            throw Error(fmt::format("shader {}: layout({}) {}; right is layout(points) {}, a point a particle",
                                    stage->files.front(), name(primitive), direction, direction));
    }
}

} // namespace lockstep
