#include "gpu/collision_trace.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision_pass.hpp"
#include "gpu/glsl_type.hpp"
#include "reference/model/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::string_view prefix = "trace_";
constexpr std::string_view neighbour_prefix = "trace_neighbour_";
constexpr std::string_view neighbour_count = "trace_neighbour_count";
constexpr int most_neighbours = 65536;

std::vector<ShaderSource> trace_build(const Switches& switches, const std::filesystem::path& shaders) {
    ShaderDefines defines = switch_defines(switches);
    defines.emplace_back("LOCKSTEP_TRACE", "1");
    const std::array stages{Stage::vertex, Stage::geometry, Stage::fragment};
    return load_stages(shader_folders(shaders), "collision_pass", stages, defines);
}

int components(const Capture& capture) { return output_components(capture.type) * capture.size; }

bool has_stage(std::span<const ShaderSource> stages, Stage stage) {
    return std::any_of(stages.begin(), stages.end(), [&](const ShaderSource& s) { return s.stage == stage; });
}

void append(std::vector<Capture>& to, const std::vector<Capture>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void append(CapturedVertex& to, const CapturedVertex& from) {
    to.outputs.insert(to.outputs.end(), from.outputs.begin(), from.outputs.end());
}

/// Moves those whose names start with `of` to a vertex of their own.
CapturedVertex take(CapturedVertex& from, std::string_view of) {
    CapturedVertex taken;
    const auto kept =
        std::stable_partition(from.outputs.begin(), from.outputs.end(), [&](const CapturedOutput& output) {
            return !output.name.starts_with(of) || output.name == neighbour_count;
        });
    std::move(kept, from.outputs.end(), std::back_inserter(taken.outputs));
    from.outputs.erase(kept, from.outputs.end());
    return taken;
}

/// The particle's state as outputs PREFIXPosition and so on hold it.
std::optional<ParticleState> state_of(const CapturedVertex& vertex, const std::string& name) {
    const RecordLayout& records = particle_records();
    ParticleState state;
    const WritableView into = view(state);
    for (const RecordLayout::Member& member : records.members) {
        const CapturedOutput* output = vertex.find(name + member.name, glsl_type(records.field(member)));
        if (output == nullptr)
            return {};
        std::memcpy(into.columns[member.field], output->words.data(), output->words.size() * sizeof(std::uint32_t));
    }
    return state;
}

/// While it lives, nothing is drawn.
struct NothingDrawn {
    NothingDrawn() { gl::Enable(GL_RASTERIZER_DISCARD); }
    ~NothingDrawn() { gl::Disable(GL_RASTERIZER_DISCARD); }
    NothingDrawn(const NothingDrawn&) = delete;
    NothingDrawn& operator=(const NothingDrawn&) = delete;
};

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

CollisionTrace::CollisionTrace(const Switches& switches, const std::filesystem::path& shaders, int width, int height)
    : target_(width, height, switches.cdt_format) {
    const std::vector<ShaderSource> stages = trace_build(switches, shaders);
    const auto vertex = std::find_if(stages.begin(), stages.end(),
                                     [](const ShaderSource& source) { return source.stage == Stage::vertex; });
    const bool geometry = has_stage(stages, Stage::geometry);
    std::vector<Capture> ordinary = particle_records().captures();
    ordinary.push_back({"gl_Position", GL_FLOAT_VEC4});
    if (geometry)
        append(ordinary, outputs_with(prefix, stages));
    whole_pass_ = parts("trace build of collision_pass", stages, ordinary);
    if (vertex == stages.end())
        return;
    const std::span<const ShaderSource> alone(&*vertex, 1);
    std::vector<Capture> traced = outputs_with(prefix, alone);
    for (const std::string handed_on : {"v_", "out_"})
        for (const RecordLayout::Member& member : particle_records().members)
            for (const Capture& output : outputs_with(handed_on + member.name, alone))
                if (output.name == handed_on + member.name)
                    traced.push_back(output);
    vertex_stage_ = parts("trace build of collision_pass, vertex stage", alone, traced);
}

std::vector<CollisionTrace::Part> CollisionTrace::parts(const std::string& name, std::span<const ShaderSource> stages,
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
    std::vector<Part> parts;
    for (std::vector<Capture>& group : groups) {
        Program program(name, stages, group);
        parts.push_back({std::move(group), std::move(program)});
    }
    return parts;
}

std::vector<CapturedVertex> CollisionTrace::capture(const Part& part, const FrameParams& params,
                                                    const ParticleBuffer& from, std::size_t particle, int instances) {
    std::size_t words_each = 0;
    for (const Capture& output : part.captured)
        words_each += static_cast<std::size_t>(components(output));
    set_collision_uniforms(part.program, params);
    const GlVertexArray vertices = vertex_array(from, part.program);
    gl::BindVertexArray(vertices.id());
    const GlBuffer buffer;
    const GlQuery written;
    const auto count = static_cast<std::size_t>(instances);
    std::vector<std::uint32_t> words(count * words_each);
    const auto bytes = static_cast<GLsizeiptr>(words.size() * sizeof(std::uint32_t));
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.id());
    gl::BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    part.program.use();
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArraysInstanced(GL_POINTS, static_cast<GLint>(particle), 1, instances);
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint points = 0;
    gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &points);
    gl::GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, words.data());
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    gl::BindVertexArray(0);
    check_gl(part.program.name());
    if (points != static_cast<GLuint>(instances))
        throw Error(
            fmt::format("{}: transform feedback wrote {} points for {}", part.program.name(), points, instances));

    std::vector<CapturedVertex> captured(count);
    auto word = words.cbegin();
    for (CapturedVertex& vertex : captured)
        for (const Capture& output : part.captured) {
            const auto end = word + components(output);
            vertex.outputs.push_back({output.name, declared_type(output.type, output.size), is_float_type(output.type),
                                      std::vector<std::uint32_t>(word, end)});
            word = end;
        }
    return captured;
}

void CollisionTrace::capture_vertex_stage(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                          StepCapture& step) const {
    const NothingDrawn guard;
    for (const Part& part : vertex_stage_)
        append(step.vertex, capture(part, params, from, particle, 1).front());
    const int instances = std::clamp(step.vertex.integer(neighbour_count).value_or(1), 0, most_neighbours);
    take(step.vertex, neighbour_prefix);
    step.neighbours.resize(static_cast<std::size_t>(instances));
    if (instances > 0)
        for (const Part& part : vertex_stage_) {
            std::vector<CapturedVertex> captured = capture(part, params, from, particle, instances);
            for (std::size_t i = 0; i < captured.size(); ++i)
                append(step.neighbours[i], take(captured[i], neighbour_prefix));
        }
    for (const std::string handed_on : {"v_", "out_"}) {
        if (const auto state = state_of(step.vertex, handed_on))
            step.vertex_state = state;
        take(step.vertex, handed_on);
    }
}

void CollisionTrace::capture_whole_pass(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                        StepCapture& step) {
    target_.clear();
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    for (const Part& part : whole_pass_)
        append(step.last, capture(part, params, from, particle, 1).front());
    step.state = state_of(step.last, "out_").value_or(ParticleState{});
    step.position = step.last.vec4("gl_Position").value_or(glm::vec4(0.0F));
    take(step.last, "out_");
    take(step.last, "gl_");
    CollisionImage drawn;
    DepthImage depth;
    target_.read(drawn);
    target_.read(depth);
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            if (depth.at(x, y) < 1.0F) {
                step.texel = {x, y};
                step.depth = depth.at(x, y);
                step.code = drawn.at(x, y);
            }
}

StepCapture CollisionTrace::run(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                const CollisionTexture& cdt) {
    StepCapture step;
    cdt.bind_texture(0);
    target_.bind_target();
    capture_vertex_stage(params, from, particle, step);
    capture_whole_pass(params, from, particle, step);
    return step;
}

} // namespace lockstep
