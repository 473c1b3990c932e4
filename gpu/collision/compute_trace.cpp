#include "gpu/collision/compute_trace.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_pass.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/compute_collision_pass.hpp"
#include "gpu/collision/trace_outputs.hpp"
#include "gpu/glsl_type.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr GLuint nowhere = 0xffffffffU;

Program link_trace(const std::string& pass, const Switches& switches, const std::filesystem::path& shaders) {
    ShaderDefines defines = switch_defines(switches);
    defines.emplace_back("LOCKSTEP_TRACE", "1");
    const std::array stages{Stage::compute};
    return {"trace build of " + pass, load_stages(collision_shaders(shaders), pass, stages, defines)};
}

/// A storage buffer of this many bytes, of ones.
void allocate(GLuint binding, const GlBuffer& buffer, std::size_t bytes) {
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
    gl::ClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nowhere);
}

std::vector<std::uint32_t> words_of(GLuint buffer, std::size_t first_byte, std::size_t count) {
    std::vector<std::uint32_t> words(count);
    gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
    gl::GetBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(first_byte),
                         static_cast<GLsizeiptr>(count * sizeof(std::uint32_t)), words.data());
    return words;
}

ParticleState state_of(const std::vector<std::uint32_t>& record) {
    ParticleState state;
    const WritableView into = view(state);
    const RecordLayout& records = particle_records();
    const std::uint32_t* word = record.data();
    for (const RecordLayout::Member& member : records.members) {
        const auto size = static_cast<std::size_t>(records.field(member).components);
        std::memcpy(into.columns[member.field], word, size * sizeof *word);
        word += size;
    }
    return state;
}

/// Those whose names start with neighbour_prefix go to a vertex of their own.
CapturedVertex take_neighbour(CapturedVertex& from) {
    CapturedVertex taken;
    const auto kept = std::stable_partition(from.outputs.begin(), from.outputs.end(), [](const CapturedOutput& output) {
        return !output.name.starts_with(neighbour_prefix) || output.name == neighbour_count;
    });
    std::move(kept, from.outputs.end(), std::back_inserter(taken.outputs));
    from.outputs.erase(kept, from.outputs.end());
    return taken;
}

} // namespace

ComputeTrace::ComputeTrace(const std::string& pass, SetUniforms set_uniforms, const Switches& switches,
                           const std::filesystem::path& shaders, int width, int height)
    : program_(link_trace(pass, switches, shaders)), set_uniforms_(set_uniforms), bound_(bind_particles(program_)),
      width_(width), height_(height) {
    std::array<GLint, 3> size{};
    gl::GetProgramiv(program_.id(), GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    group_ = static_cast<std::size_t>(size[0]);
    if (program_.uses_storage(trace_binding))
        find_members();
}

void ComputeTrace::find_members() {
    for (const InterfaceBlock& block : program_.storage_blocks())
        for (const BlockMember& member : block.members) {
            const std::string name = member.name.substr(member.name.rfind('.') + 1);
            if (!name.starts_with(trace_prefix) || member.top_level_stride <= 0)
                continue;
            stride_ = static_cast<std::size_t>(member.top_level_stride);
            members_.push_back({name, member.type, static_cast<std::size_t>(member.offset)});
        }
}

void ComputeTrace::dispatch(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                            const CollisionTexture& cdt, std::size_t invocations) {
    const std::size_t groups = (invocations + group_ - 1) / group_;
    program_.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    program_.set("u_TracedParticle", static_cast<unsigned>(particle));
    set_uniforms_(program_, params);
    program_.check_interface();
    cdt.bind_texture(0);
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, before_binding, from.id());
    if (!after_ || after_->size() != from.size())
        after_.emplace(from.size());
    after_->fill(nowhere);
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, after_binding, after_->id());
    const RecordBuffer* const before[] = {&from};
    const RecordBuffer* const after[] = {&*after_};
    bound_.fill(before, after);
    allocate(nearest_binding, nearest_,
             2 * sizeof(GLuint) * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    allocate(offers_binding, offers_, 2 * sizeof(GLuint) * from.size());
    if (!members_.empty())
        allocate(trace_binding, traces_, stride_ * groups * group_);
    gl::DispatchCompute(static_cast<GLuint>(groups), 1, 1);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    bound_.collect(after);
    gl::UseProgram(0);
    check_gl(program_.name());
}

std::vector<CapturedVertex> ComputeTrace::told(std::size_t invocations) const {
    std::vector<CapturedVertex> captured(invocations);
    const std::size_t words_each = stride_ / sizeof(std::uint32_t);
    const std::vector<std::uint32_t> words = words_of(traces_.id(), 0, invocations * words_each);
    for (std::size_t i = 0; i < invocations; ++i)
        for (const Member& member : members_) {
            const auto first =
                words.begin() + static_cast<std::ptrdiff_t>(i * words_each + member.offset / sizeof words[0]);
            captured[i].outputs.push_back({member.name, type_name(member.type), is_float_type(member.type),
                                           std::vector(first, first + output_components(member.type))});
        }
    return captured;
}

StepCapture ComputeTrace::run(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                              const CollisionTexture& cdt) {
    StepCapture step;
    dispatch(params, from, particle, cdt, members_.empty() ? from.size() : 1);
    if (!members_.empty()) {
        step.vertex = told(1).front();
        const int neighbours = std::clamp(step.vertex.integer(neighbour_count).value_or(0), 0, most_neighbours);
        take_neighbour(step.vertex);
        if (neighbours > 0) {
            dispatch(params, from, particle, cdt, static_cast<std::size_t>(neighbours));
            for (CapturedVertex& one : told(static_cast<std::size_t>(neighbours)))
                step.neighbours.push_back(take_neighbour(one));
        }
    }
    const std::size_t record = particle_records().bytes();
    step.state = state_of(words_of(after_->id(), particle * record, record / sizeof(std::uint32_t)));
    step.drawn_alone = program_.uses_storage(offers_binding);
    if (!step.drawn_alone)
        return step;
    const std::vector<std::uint32_t> offer = words_of(offers_.id(), particle * 2 * sizeof(GLuint), 2);
    if (offer[0] == nowhere)
        return step;
    step.texel = {static_cast<int>(offer[0]) % width_, static_cast<int>(offer[0]) / width_};
    std::memcpy(&step.depth, &offer[1], sizeof step.depth);
    return step;
}

} // namespace lockstep
