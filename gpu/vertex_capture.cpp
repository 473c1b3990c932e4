#include "gpu/vertex_capture.hpp"

#include <bit>
#include <utility>

#include <algorithm>
#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/glsl_type.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

int components(const Capture& capture) { return output_components(capture.type) * capture.size; }

template <class Vector> std::optional<Vector> vector_of(const CapturedOutput* output) {
    if (output == nullptr)
        return {};
    Vector v;
    for (int c = 0; c < Vector::length(); ++c)
        v[c] = std::bit_cast<typename Vector::value_type>(output->words[static_cast<std::size_t>(c)]);
    return v;
}

} // namespace

float CapturedOutput::number(std::size_t component) const { return std::bit_cast<float>(words[component]); }

std::int32_t CapturedOutput::integer(std::size_t component) const {
    return std::bit_cast<std::int32_t>(words[component]);
}

const CapturedOutput* CapturedVertex::find(std::string_view name, std::string_view type) const {
    const auto found = std::find_if(outputs.begin(), outputs.end(), [&](const CapturedOutput& output) {
        return output.name == name && output.type == type;
    });
    return found == outputs.end() ? nullptr : &*found;
}

std::optional<float> CapturedVertex::real(std::string_view name) const {
    const CapturedOutput* output = find(name, "float");
    return output == nullptr ? std::nullopt : std::optional(output->number(0));
}

std::optional<std::int32_t> CapturedVertex::integer(std::string_view name) const {
    const CapturedOutput* output = find(name, "int");
    return output == nullptr ? std::nullopt : std::optional(output->integer(0));
}

std::optional<glm::ivec2> CapturedVertex::integers(std::string_view name) const {
    return vector_of<glm::ivec2>(find(name, "ivec2"));
}

std::optional<glm::vec2> CapturedVertex::vec2(std::string_view name) const {
    return vector_of<glm::vec2>(find(name, "vec2"));
}

std::optional<glm::vec3> CapturedVertex::vec3(std::string_view name) const {
    return vector_of<glm::vec3>(find(name, "vec3"));
}

std::optional<glm::vec4> CapturedVertex::vec4(std::string_view name) const {
    return vector_of<glm::vec4>(find(name, "vec4"));
}

VertexCapture::VertexCapture(const std::string& name, std::span<const ShaderSource> stages,
                             std::vector<Capture> captured)
    : captured_(std::move(captured)), program_(name, stages, captured_) {}

std::vector<VertexCapture> vertex_captures(const std::string& name, std::span<const ShaderSource> stages,
                                           std::span<const Capture> captured) {
    GLint most = 0;
    gl::GetIntegerv(GL_MAX_TRANSFORM_FEEDBACK_INTERLEAVED_COMPONENTS, &most);
    std::vector<std::vector<Capture>> groups;
    int room = 0;
    for (const Capture& capture : captured) {
        if (components(capture) == 0 || components(capture) > most)
            throw Error(fmt::format("{}: output {} is {}, which cannot be captured; scalars, vectors and matrices of "
                                    "float, int and uint can",
                                    name, capture.name, declared_type(capture.type, capture.size)));
        if (groups.empty() || components(capture) > room) {
            groups.emplace_back();
            room = most;
        }
        groups.back().push_back(capture);
        room -= components(capture);
    }
    std::vector<VertexCapture> captures;
    for (std::vector<Capture>& group : groups)
        captures.emplace_back(name, stages, std::move(group));
    return captures;
}

std::vector<CapturedVertex> VertexCapture::run(const RecordBuffer& from, std::size_t item, int instances) const {
    std::size_t words_each = 0;
    for (const Capture& output : captured_)
        words_each += static_cast<std::size_t>(components(output));
    const GlVertexArray vertices = vertex_array(from, program_);
    gl::BindVertexArray(vertices.id());
    const GlBuffer buffer;
    const GlQuery written;
    const auto count = static_cast<std::size_t>(instances);
    std::vector<std::uint32_t> words(count * words_each);
    const auto bytes = static_cast<GLsizeiptr>(words.size() * sizeof(std::uint32_t));
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.id());
    gl::BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    program_.use();
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArraysInstanced(GL_POINTS, static_cast<GLint>(item), 1, instances);
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint points = 0;
    gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &points);
    gl::GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, words.data());
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    gl::BindVertexArray(0);
    check_gl(program_.name());
    if (points != static_cast<GLuint>(instances))
        throw Error(fmt::format("{}: transform feedback wrote {} points for {}", program_.name(), points, instances));

    std::vector<CapturedVertex> captured(count);
    auto word = words.cbegin();
    for (CapturedVertex& vertex : captured)
        for (const Capture& output : captured_) {
            const auto end = word + components(output);
            vertex.outputs.push_back({output.name, declared_type(output.type, output.size), is_float_type(output.type),
                                      std::vector<std::uint32_t>(word, end)});
            word = end;
        }
    return captured;
}

} // namespace lockstep
