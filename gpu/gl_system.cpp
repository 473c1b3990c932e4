#include "gpu/gl_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/check.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"
#include "gpu/texture.hpp"
#include "gpu/vertex_capture.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::string block_name(const Resource& resource, bool after) {
    return shader_name(resource.name) + (after ? "After" : "Before");
}

/// Binds the program's storage blocks by name: resource r before at 2 r, after at 2 r + 1. Returns the resources.
std::vector<std::uint8_t> bind_blocks(const Program& program, const Schema& schema) {
    GLint count = 0;
    gl::GetProgramInterfaceiv(program.id(), GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    std::vector<std::uint8_t> bound;
    GLint known = 0;
    std::vector<std::string> names;
    for (std::uint8_t r = 0; r < schema.resources.size(); ++r)
        for (const bool after : {false, true}) {
            names.push_back(block_name(schema.resources[r], after));
            const GLuint block =
                gl::GetProgramResourceIndex(program.id(), GL_SHADER_STORAGE_BLOCK, names.back().c_str());
            if (block == GL_INVALID_INDEX)
                continue;
            gl::ShaderStorageBlockBinding(program.id(), block, 2U * r + (after ? 1U : 0U));
            ++known;
            if (bound.empty() || bound.back() != r)
                bound.push_back(r);
        }
    if (known != count)
        throw Error(fmt::format("{}: nothing is given for {} of its storage buffers; the names are {}", program.name(),
                                count - known, fmt::join(names, ", ")));
    return bound;
}

void check_stage(const GlPass& pass, const Schema& schema) {
    if (pass.stage != Stage::vertex && pass.stage != Stage::compute)
        throw Error(fmt::format("{}: a pass is a vertex or a compute shader", pass.name));
    if (pass.resource >= schema.resources.size())
        throw Error(fmt::format("{}: {} has no buffer {}", pass.name, schema.system, pass.resource));
}

void set_uniforms(const Program& program, const GlPass& pass, std::size_t items, int frame) {
    program.set("u_ItemCount", static_cast<unsigned>(items));
    if (pass.uniforms)
        for (const auto& [name, value] : pass.uniforms(frame))
            std::visit([&](const auto& v) { program.set(name, v); }, value);
}

/// A framebuffer of one texel. A context without a surface has none, and then draws nothing: not even a point that
/// transform feedback alone would have.
class SmallestTarget {
  public:
    SmallestTarget() {
        allocate_texture(color_.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, 1, 1);
        bind();
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
        check_framebuffer(GL_FRAMEBUFFER, "framebuffer of one texel");
    }
    void bind() const { gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id()); }

  private:
    GlTexture color_;
    GlFramebuffer framebuffer_;
};

} // namespace

void SystemSide::repeat_step(std::size_t /*pass*/, int /*frame*/) {
    throw Error(fmt::format("{}: says that it repeats a pass, but has no repeat_step", describe().name));
}

std::vector<CapturedVertex> SystemSide::trace(std::size_t /*pass*/, int /*frame*/, std::size_t /*item*/) { return {}; }

std::string shader_name(std::string_view name) {
    std::string camel;
    bool upper = true;
    for (const char c : name) {
        if (c != '_')
            camel += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        upper = c == '_';
    }
    return camel;
}

struct GlSystem::Parts {
    struct Linked {
        GlPass pass;
        Program program;
        std::vector<std::uint8_t> bound; ///< of a compute pass: the resources it has blocks of
        std::optional<std::vector<VertexCapture>> traced;
    };
    const Schema* schema;
    std::filesystem::path shaders;
    ArithmeticSwitch arithmetic;
    std::vector<RecordLayout> layouts; ///< one a buffer
    std::vector<Linked> passes;
    std::vector<std::vector<RecordBuffer>> buffers; ///< two a buffer
    std::vector<std::size_t> current;               ///< which of the two the next pass reads
    SmallestTarget target = {};                     ///< of vertex passes

    void run(const Linked& linked, int frame);
    [[nodiscard]] std::vector<ShaderSource> sources(const GlPass& pass, bool traced) const;
    [[nodiscard]] RecordBuffer& from(std::uint8_t resource) { return buffers[resource][current[resource]]; }
    [[nodiscard]] RecordBuffer& to(std::uint8_t resource) { return buffers[resource][1 - current[resource]]; }
};

GlSystem::~GlSystem() = default;

GlSystem::GlSystem(const Schema& schema, std::vector<GlPass> passes, std::filesystem::path shaders,
                   ArithmeticSwitch arithmetic)
    : parts_(new Parts{
          &schema, std::move(shaders), arithmetic, {}, {}, {}, std::vector<std::size_t>(schema.resources.size()), {}}) {
    for (std::uint8_t r = 0; r < schema.resources.size(); ++r) {
        const Resource& resource = schema.resources[r];
        if (resource.dimensions != 1)
            throw Error(fmt::format("{}: '{}' is an image; GlSystem has buffers alone", schema.system, resource.name));
        RecordLayout& layout = parts_->layouts.emplace_back(RecordLayout{&schema, r, {}});
        for (std::uint8_t f = 0; f < resource.fields.size(); ++f)
            layout.members.push_back({f, shader_name(resource.fields[f].name)});
    }
    for (GlPass& pass : passes) {
        check_stage(pass, schema);
        const std::vector<ShaderSource> stages = parts_->sources(pass, false);
        const std::vector<Capture> captures =
            pass.stage == Stage::vertex ? parts_->layouts[pass.resource].captures() : std::vector<Capture>{};
        Program program(pass.name, stages, captures);
        if (pass.stage == Stage::vertex)
            check_nothing_lost(stages, captures);
        std::vector<std::uint8_t> bound;
        if (pass.stage == Stage::compute)
            bound = bind_blocks(program, schema);
        parts_->passes.push_back({std::move(pass), std::move(program), std::move(bound), {}});
    }
}

std::vector<ShaderSource> GlSystem::Parts::sources(const GlPass& pass, bool traced) const {
    ShaderDefines defines = arithmetic_defines(arithmetic);
    if (traced)
        defines.emplace_back("LOCKSTEP_TRACE", "1");
    return load_stages(shader_folders(shaders, schema->system), pass.name, std::array{pass.stage}, defines);
}

void GlSystem::upload(const SystemView& state) {
    parts_->buffers.clear();
    for (std::uint8_t r = 0; r < parts_->layouts.size(); ++r) {
        std::vector<RecordBuffer>& two = parts_->buffers.emplace_back();
        for (int i = 0; i < 2; ++i)
            two.emplace_back(parts_->layouts[r], state[r].count());
        parts_->current[r] = 0;
        parts_->from(r).upload(state[r]);
    }
}

void GlSystem::Parts::run(const Linked& linked, int frame) {
    const GlPass& pass = linked.pass;
    const RecordBuffer& source = from(pass.resource);
    RecordBuffer& written_to = to(pass.resource);
    set_uniforms(linked.program, pass, source.size(), frame);
    if (pass.stage == Stage::vertex) {
        const GlVertexArray vertices = vertex_array(source, linked.program);
        linked.program.check_interface();
        const GlQuery written;
        linked.program.use();
        gl::BindVertexArray(vertices.id());
        target.bind();
        written_to.bind_capture();
        gl::Enable(GL_RASTERIZER_DISCARD);
        gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
        gl::BeginTransformFeedback(GL_POINTS);
        gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(source.size()));
        gl::EndTransformFeedback();
        gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
        gl::Disable(GL_RASTERIZER_DISCARD);
        gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
        gl::BindVertexArray(0);
        GLuint points = 0;
        gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &points);
        if (points != source.size())
            throw Error(fmt::format("{}: transform feedback wrote {} of {} items", pass.name, points, source.size()));
    } else {
        linked.program.check_interface();
        linked.program.use();
        for (const std::uint8_t r : linked.bound) {
            gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2U * r, from(r).id());
            gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2U * r + 1U, to(r).id());
        }
        std::array<GLint, 3> group{1, 1, 1};
        gl::GetProgramiv(linked.program.id(), GL_COMPUTE_WORK_GROUP_SIZE, group.data());
        const auto invocations = static_cast<std::size_t>(group[0]) * static_cast<std::size_t>(group[1]) *
                                 static_cast<std::size_t>(group[2]);
        gl::DispatchCompute(static_cast<GLuint>((source.size() + invocations - 1) / invocations), 1, 1);
        gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                          GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    gl::UseProgram(0);
    gl::Finish();
    check_gl(pass.name);
}

void GlSystem::step(std::size_t pass, int frame) {
    const Parts::Linked& linked = parts_->passes.at(pass);
    parts_->run(linked, frame);
    parts_->current[linked.pass.resource] = 1 - parts_->current[linked.pass.resource];
}

void GlSystem::repeat_step(std::size_t pass, int frame) {
    std::size_t& current = parts_->current[parts_->passes.at(pass).pass.resource];
    current = 1 - current;
    step(pass, frame);
}

void GlSystem::lay_canary(std::size_t pass) { parts_->to(parts_->passes.at(pass).pass.resource).fill(canary_word); }

void GlSystem::read(SystemState& state) const {
    for (std::uint8_t r = 0; r < parts_->layouts.size(); ++r)
        parts_->buffers[r][parts_->current[r]].read(state[r]);
}

std::vector<CapturedVertex> GlSystem::trace(std::size_t pass, int frame, std::size_t item) {
    Parts::Linked& linked = parts_->passes.at(pass);
    if (linked.pass.stage != Stage::vertex)
        return {};
    if (!linked.traced) {
        const std::vector<ShaderSource> stages = parts_->sources(linked.pass, true);
        const std::vector<Capture> outputs = outputs_with("trace_", stages);
        linked.traced = outputs.empty() ? std::vector<VertexCapture>{}
                                        : vertex_captures("trace build of " + linked.pass.name, stages, outputs);
    }
    // What the pass wrote is what it read the last time.
    const RecordBuffer& source = parts_->to(linked.pass.resource);
    CapturedVertex all;
    parts_->target.bind();
    gl::Enable(GL_RASTERIZER_DISCARD);
    for (const VertexCapture& part : *linked.traced) {
        set_uniforms(part.program(), linked.pass, source.size(), frame);
        const CapturedVertex one = part.run(source, item, 1).front();
        all.outputs.insert(all.outputs.end(), one.outputs.begin(), one.outputs.end());
    }
    gl::Disable(GL_RASTERIZER_DISCARD);
    return {all};
}

} // namespace lockstep
