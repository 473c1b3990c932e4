#include "gpu/collision/collision_trace.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_pass.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/host_depth.hpp"
#include "gpu/collision/trace_outputs.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::vector<ShaderSource> trace_build(const Switches& switches, const std::filesystem::path& shaders,
                                      const ClipDepth& depth) {
    ShaderDefines defines = switch_defines(switches);
    for (const auto& define : clip_depth_defines(depth))
        defines.push_back(define);
    defines.emplace_back("LOCKSTEP_TRACE", "1");
    const std::array stages{Stage::vertex, Stage::geometry, Stage::fragment};
    return load_stages(collision_shaders(shaders), "collision_pass", stages, defines);
}

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

std::vector<CapturedVertex> capture(const VertexCapture& part, const FrameParams& params, const ParticleBuffer& from,
                                    std::size_t particle, int instances) {
    set_collision_uniforms(part.program(), params);
    return part.run(from, particle, instances);
}

/// While it lives, nothing is drawn.
struct NothingDrawn {
    NothingDrawn() { gl::Enable(GL_RASTERIZER_DISCARD); }
    ~NothingDrawn() { gl::Disable(GL_RASTERIZER_DISCARD); }
    NothingDrawn(const NothingDrawn&) = delete;
    NothingDrawn& operator=(const NothingDrawn&) = delete;
};

} // namespace

CollisionTrace::CollisionTrace(const Switches& switches, const std::filesystem::path& shaders, int width, int height,
                               const ClipDepth& depth)
    : target_(width, height, switches.cdt_format) {
    const std::vector<ShaderSource> stages = trace_build(switches, shaders, depth);
    const auto vertex = std::find_if(stages.begin(), stages.end(),
                                     [](const ShaderSource& source) { return source.stage == Stage::vertex; });
    const bool geometry = has_stage(stages, Stage::geometry);
    std::vector<Capture> ordinary = particle_records().captures();
    ordinary.push_back({"gl_Position", GL_FLOAT_VEC4});
    if (geometry)
        append(ordinary, outputs_with(trace_prefix, stages));
    whole_pass_ = vertex_captures("trace build of collision_pass", stages, ordinary);
    if (vertex == stages.end())
        return;
    const std::span<const ShaderSource> alone(&*vertex, 1);
    std::vector<Capture> traced = outputs_with(trace_prefix, alone);
    for (const std::string handed_on : {"v_", "out_"})
        for (const RecordLayout::Member& member : particle_records().members)
            for (const Capture& output : outputs_with(handed_on + member.name, alone))
                if (output.name == handed_on + member.name)
                    traced.push_back(output);
    vertex_stage_ = vertex_captures("trace build of collision_pass, vertex stage", alone, traced);
}

void CollisionTrace::capture_vertex_stage(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                          StepCapture& step) const {
    const NothingDrawn guard;
    for (const VertexCapture& part : vertex_stage_)
        append(step.vertex, capture(part, params, from, particle, 1).front());
    const int instances = std::clamp(step.vertex.integer(neighbour_count).value_or(1), 0, most_neighbours);
    take(step.vertex, neighbour_prefix);
    step.neighbours.resize(static_cast<std::size_t>(instances));
    if (instances > 0)
        for (const VertexCapture& part : vertex_stage_) {
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
    const float far_plane = params.clip_depth.cleared();
    target_.clear(far_plane);
    const HostDepth host(params.clip_depth);
    for (const VertexCapture& part : whole_pass_)
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
            if (depth.at(x, y) != far_plane) {
                step.texel = {x, y};
                step.depth = params.clip_depth.sign() * depth.at(x, y);
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
