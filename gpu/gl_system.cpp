#include "gpu/gl_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/type_ptr.hpp>

#include "gpu/bound_storage.hpp"
#include "gpu/check.hpp"
#include "gpu/pass_timer.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/state_image.hpp"
#include "gpu/texture.hpp"
#include "gpu/vertex_capture.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

std::string block_name(const Resource& resource, bool after) {
    return shader_name(resource.name) + (after ? "After" : "Before");
}

/// The fields of a buffer that lie in one GL buffer: all of them in two copies, or those of a block, changed in place.
struct Storage {
    RecordLayout layout;
    std::string block; ///< empty: BufferBefore and BufferAfter
};

/// The storages of a schema, buffer by buffer.
std::vector<Storage> storages_of(const Schema& schema) {
    std::vector<Storage> all;
    for (std::uint8_t r = 0; r < schema.resources.size(); ++r) {
        const Resource& resource = schema.resources[r];
        if (resource.dimensions != 1) {
            static_cast<void>(image_format(resource));
            continue;
        }
        const std::size_t first = all.size();
        for (std::uint8_t f = 0; f < resource.fields.size(); ++f) {
            const auto known = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                                            [&](const Storage& s) { return s.block == resource.fields[f].block; });
            Storage& storage =
                known != all.end() ? *known : all.emplace_back(Storage{{&schema, r, {}}, resource.fields[f].block});
            storage.layout.members.push_back({f, shader_name(resource.fields[f].name)});
        }
    }
    return all;
}

/// A storage block of a program, at the binding point of its place among them.
struct Bound {
    enum class Kind : std::uint8_t { before, after, in_place, data };
    Kind kind;
    std::size_t storage = 0; ///< its number
    std::string name;        ///< of data
};

/// The blocks of ours by their names.
std::map<std::string, Bound> our_blocks(const Schema& schema, const std::vector<Storage>& storages,
                                        const GlPass& pass) {
    std::map<std::string, Bound> all;
    for (std::size_t s = 0; s < storages.size(); ++s) {
        const Resource& resource = schema.resources[storages[s].layout.resource];
        if (storages[s].block.empty()) {
            all[block_name(resource, false)] = {Bound::Kind::before, s, {}};
            all[block_name(resource, true)] = {Bound::Kind::after, s, {}};
        } else {
            all[storages[s].block] = {Bound::Kind::in_place, s, {}};
        }
    }
    for (const auto& [name, words] : pass.data)
        all[name] = {Bound::Kind::data, 0, name};
    return all;
}

/// Those in two copies, which a shader's own blocks can be bound to by member.
std::vector<RecordBlocks> blocks_of_records(const Schema& schema, const std::vector<Storage>& storages) {
    std::vector<RecordBlocks> all;
    for (const Storage& storage : storages) {
        const Resource& resource = schema.resources[storage.layout.resource];
        if (storage.block.empty())
            all.push_back(
                {block_name(resource, false), block_name(resource, true), &storage.layout, shader_name(resource.name)});
    }
    return all;
}

/// Gives every storage block of the program its binding point, by name or by the bindings beside the shader; those
/// bound by member have the last. Throws Error for one that nothing is given for.
std::vector<Bound> bind_blocks(const Program& program, const Schema& schema, const std::vector<Storage>& storages,
                               const GlPass& pass) {
    const std::map<std::string, Bound> ours = our_blocks(schema, storages, pass);
    std::vector<std::string> names;
    for (const auto& [name, what] : ours)
        names.push_back(name);
    std::vector<Bound> bound;
    std::vector<GLuint> by_member;
    const std::vector<StorageBlock> blocks = storage_blocks(program, names);
    for (GLuint block = 0; block < static_cast<GLuint>(blocks.size()); ++block) {
        if (blocks[block].ours.empty()) {
            by_member.push_back(block);
            continue;
        }
        const auto known = ours.find(blocks[block].ours);
        if (known == ours.end())
            throw Error(fmt::format("{}: nothing is given for storage block {}; right is one of {}, or {} beside the "
                                    "shader (docs/own_shader.md){}",
                                    program.name(), blocks[block].name, fmt::join(names, ", "), bindings_file,
                                    did_you_mean(blocks[block].name, names)));
        gl::ShaderStorageBlockBinding(program.id(), block, static_cast<GLuint>(bound.size()));
        bound.push_back(known->second);
    }
    for (std::size_t b = 0; b < by_member.size(); ++b)
        gl::ShaderStorageBlockBinding(program.id(), by_member[b], static_cast<GLuint>(bound.size() + b));
    return bound;
}

void check_stage(const GlPass& pass, const Schema& schema) {
    if (pass.stage != Stage::vertex && pass.stage != Stage::compute)
        throw Error(fmt::format("{}: a pass is a vertex or a compute shader", pass.name));
    if (pass.resource >= schema.resources.size())
        throw Error(fmt::format("{}: {} has no buffer {}", pass.name, schema.system, pass.resource));
    const Resource& made = schema.resources[pass.resource];
    const bool is_image = made.dimensions > 1, draws = pass.draw.has_value();
    if (pass.continues && is_image)
        return;
    if (pass.stage == Stage::vertex && is_image != draws)
        throw Error(fmt::format("{}: a vertex shader makes {} {}", pass.name, made.title,
                                is_image ? "where it says how it draws" : "by transform feedback, and draws nothing"));
    if (draws && (pass.stage != Stage::vertex || pass.draw->buffer >= schema.resources.size() ||
                  schema.resources[pass.draw->buffer].dimensions != 1 || pass.instances_of))
        throw Error(fmt::format("{}: a vertex shader draws items of a buffer into an image", pass.name));
    if (is_image && pass.indirect)
        throw Error(fmt::format("{}: {} are made by a dispatch of a known size", pass.name, made.title));
    const bool in_place = !made.fields.front().block.empty();
    if (pass.stage == Stage::vertex && in_place)
        throw Error(
            fmt::format("{}: {} has storage blocks, which a vertex shader cannot change", pass.name, made.title));
    if (pass.instances_of && (pass.stage != Stage::vertex || *pass.instances_of >= schema.resources.size()))
        throw Error(
            fmt::format("{}: instances are those of a buffer of {}, for a vertex shader", pass.name, schema.system));
    if (pass.stage == Stage::vertex && !pass.data.empty())
        throw Error(fmt::format("{}: a vertex shader has no storage blocks", pass.name));
}

void set_uniforms(const Program& program, const GlPass& pass, std::size_t items, int frame) {
    program.set("u_ItemCount", static_cast<unsigned>(items));
    if (pass.uniforms)
        for (const auto& [name, value] : pass.uniforms(frame))
            std::visit([&](const auto& v) { program.set(name, v); }, value);
}

void blend_by(GlDraw::Blend blend) {
    if (blend == GlDraw::Blend::none)
        return gl::Disable(GL_BLEND);
    gl::Enable(GL_BLEND);
    blend == GlDraw::Blend::added ? gl::BlendFunc(GL_ONE, GL_ONE) : gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
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
        std::vector<Bound> bound;                     ///< of a compute pass
        BoundStorage by_member;                       ///< the rest of its blocks
        std::vector<std::uint8_t> resources;          ///< that it writes
        std::array<std::size_t, 3> group = {1, 1, 1}; ///< invocations along each axis
        std::size_t invocations = 1;                  ///< of a group
        std::optional<std::vector<VertexCapture>> traced = {};
    };
    const Schema* schema;
    std::filesystem::path shaders;
    ArithmeticSwitch arithmetic;
    std::vector<Storage> storages;
    std::vector<std::optional<Linked>> passes;      ///< none: its dispatch is that of the one before
    std::vector<std::vector<RecordBuffer>> buffers; ///< two a storage
    std::vector<std::size_t> current;               ///< of each buffer and image, which of the two the next pass reads
    std::map<std::uint8_t, std::vector<StateImage>> images = {}; ///< two a resource
    SmallestTarget target = {};                                  ///< of vertex passes
    GlQuery timer = {};
    std::optional<std::size_t> canary_laid = {}; ///< in what this pass will write: its next step keeps what it read
    std::optional<std::size_t> kept = {};        ///< the pass of the last step, where that is there to be repeated from
    std::array<GlSampler, 2> samplers = {};      ///< by GlFilter
    bool takes_times = false;
    bool says_precise = true; ///< each stage that computes, of something
    Seconds seconds = {};

    /// What the pass runs in a frame; null where there is nothing.
    [[nodiscard]] const Linked* running(std::size_t pass, int frame) const;
    void run(const Linked& linked, int frame);
    void step(std::size_t pass, int frame, bool keeps);
    /// Whether all of it is changed in place, without a copy of what was there where nothing is to be kept.
    [[nodiscard]] bool in_place(std::uint8_t resource) const {
        return !is_image(resource) && std::all_of(storages.begin(), storages.end(), [&](const Storage& storage) {
            return storage.layout.resource != resource || !storage.block.empty();
        });
    }
    void capture(const Linked& linked);
    void draw(const Linked& linked);
    void dispatch_image(const Linked& linked);
    /// Lends the program the state's images, as the pass before left them.
    void lend_images(const Program& program, const GlPass& pass) const;
    [[nodiscard]] GLuint sampler(GlFilter filter) const;
    [[nodiscard]] bool is_image(std::uint8_t resource) const { return schema->resources[resource].dimensions > 1; }
    [[nodiscard]] StateImage& image_from(std::uint8_t resource) { return images.at(resource)[current[resource]]; }
    [[nodiscard]] StateImage& image_to(std::uint8_t resource) { return images.at(resource)[1 - current[resource]]; }
    /// Runs `work`, a draw or a dispatch, and takes its time.
    template <class Work> void timed(const Work& work);
    void dispatch(const Linked& linked, int frame);
    std::optional<GLintptr> group_counts(const GroupCounts& of);
    [[nodiscard]] std::vector<ShaderSource> sources(const GlPass& pass, std::span<const Stage> stages,
                                                    bool traced) const;
    /// What a program of the pass reads: an item a vertex, or an instance.
    [[nodiscard]] GlVertexArray inputs(const GlPass& pass, const Program& program);
    [[nodiscard]] std::size_t items(std::uint8_t resource) {
        return is_image(resource) ? image_from(resource).extent().count() : from(first_storage(resource)).size();
    }
    [[nodiscard]] ColorImage picture(const Linked& linked, int frame, const GlPicture& how);
    [[nodiscard]] std::size_t first_storage(std::uint8_t resource) const;
    [[nodiscard]] RecordBuffer& from(std::size_t storage) {
        return buffers[storage][current[storages[storage].layout.resource]];
    }
    [[nodiscard]] RecordBuffer& to(std::size_t storage) {
        return buffers[storage][1 - current[storages[storage].layout.resource]];
    }
};

GlSystem::~GlSystem() = default;

GlSystem::GlSystem(const Schema& schema, std::vector<GlPass> passes, std::filesystem::path shaders,
                   ArithmeticSwitch arithmetic)
    : parts_(new Parts{&schema,
                       std::move(shaders),
                       arithmetic,
                       storages_of(schema),
                       {},
                       {},
                       std::vector<std::size_t>(schema.resources.size())}) {
    Parts::Linked* last = nullptr;
    parts_->passes.reserve(passes.size());
    for (GlPass& pass : passes) {
        check_stage(pass, schema);
        if (pass.continues) {
            if (last == nullptr)
                throw Error(fmt::format("{}: continues the pass before, and is the first", pass.name));
            last->resources.push_back(pass.resource);
            parts_->passes.emplace_back();
            continue;
        }
        const bool compute = pass.stage == Stage::compute;
        const bool captured = !compute && !pass.draw;
        std::vector<Stage> used{pass.stage};
        if (pass.draw && pass.draw->has_geometry)
            used.push_back(Stage::geometry);
        if (pass.draw)
            used.push_back(Stage::fragment);
        const std::vector<ShaderSource> stages = parts_->sources(pass, used, false);
        parts_->says_precise = parts_->says_precise && lockstep::says_precise(stages.front());
        const std::vector<Capture> captures =
            captured ? parts_->storages[parts_->first_storage(pass.resource)].layout.captures()
                     : std::vector<Capture>{};
        Program program(pass.name, stages, captures);
        if (!compute)
            check_nothing_lost(stages, captures);
        std::vector<Bound> bound;
        BoundStorage by_member;
        std::array<GLint, 3> group{1, 1, 1};
        if (compute) {
            bound = bind_blocks(program, schema, parts_->storages, pass);
            by_member = BoundStorage(program, blocks_of_records(schema, parts_->storages));
            gl::GetProgramiv(program.id(), GL_COMPUTE_WORK_GROUP_SIZE, group.data());
        }
        const std::uint8_t resource = pass.resource;
        std::array<std::size_t, 3> sizes{};
        std::transform(group.begin(), group.end(), sizes.begin(), [](GLint n) { return static_cast<std::size_t>(n); });
        parts_->passes.emplace_back(Parts::Linked{std::move(pass),
                                                  std::move(program),
                                                  std::move(bound),
                                                  std::move(by_member),
                                                  {resource},
                                                  sizes,
                                                  sizes[0] * sizes[1] * sizes[2]});
        last = &*parts_->passes.back();
    }
}

std::size_t GlSystem::Parts::first_storage(std::uint8_t resource) const {
    std::size_t s = 0;
    while (storages[s].layout.resource != resource)
        ++s;
    return s;
}

const GlSystem::Parts::Linked* GlSystem::Parts::running(std::size_t pass, int frame) const {
    const std::optional<Linked>& linked = passes.at(pass);
    return linked && (!linked->pass.runs || linked->pass.runs(frame)) ? &*linked : nullptr;
}

std::vector<ShaderSource> GlSystem::Parts::sources(const GlPass& pass, std::span<const Stage> stages,
                                                   bool traced) const {
    ShaderDefines defines = arithmetic_defines(arithmetic);
    defines.insert(defines.end(), pass.defines.begin(), pass.defines.end());
    if (traced)
        defines.emplace_back("LOCKSTEP_TRACE", "1");
    return load_stages(shader_folders(shaders, schema->system), pass.name, stages, defines, pass.texts);
}

void GlSystem::upload(const SystemView& state) {
    std::size_t spare = 0; // records behind those that are changed in place: what a last group could write
    for (const auto& linked : parts_->passes)
        spare = std::max(spare, linked ? linked->invocations : 0);
    parts_->images.clear();
    for (std::uint8_t r = 0; r < parts_->schema->resources.size(); ++r) {
        parts_->current[r] = 0;
        if (!parts_->is_image(r))
            continue;
        std::vector<StateImage>& two = parts_->images[r];
        for (int i = 0; i < 2; ++i)
            two.emplace_back(parts_->schema->resources[r], state[r].extent);
        two[0].upload(state[r]);
    }
    parts_->buffers.clear();
    for (const Storage& storage : parts_->storages) {
        const std::uint8_t r = storage.layout.resource;
        std::vector<RecordBuffer>& two = parts_->buffers.emplace_back();
        for (int i = 0; i < 2; ++i) {
            two.emplace_back(storage.layout, state[r].count(), storage.block.empty() ? 0 : spare);
            two.back().fill_spare(canary_word);
        }
        two[0].upload(state[r]);
    }
}

template <class Work> void GlSystem::Parts::timed(const Work& work) {
    if (!takes_times)
        return work();
    gl::Finish();
    const auto start = std::chrono::steady_clock::now();
    {
        const RunningTimer timing(timer);
        work();
    }
    gl::Finish();
    seconds.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds.timer = seconds_of(timer);
}

GlSystem::Seconds GlSystem::seconds() const { return parts_->seconds; }

bool GlSystem::says_precise() const { return parts_->says_precise; }

void GlSystem::time_steps(bool on) { parts_->takes_times = on; }

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
    const RecordBuffer& buffer = from(first_storage(how.buffer));
    const RecordBuffer* const one[] = {&buffer};
    const GlVertexArray vertices = how.once           ? GlVertexArray()
                                   : how.vertices > 0 ? instance_array(one, linked.program)
                                                      : vertex_array(buffer, linked.program);
    linked.program.check_interface();
    linked.program.use();
    gl::BindVertexArray(vertices.id());
    const GLenum primitive = how.primitive == GlDraw::Primitive::points ? GL_POINTS : GL_TRIANGLES;
    const auto items = static_cast<GLsizei>(how.once ? 1 : buffer.size());
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

ColorImage GlSystem::picture(std::size_t pass, int frame, const GlPicture& how) {
    const Parts::Linked* linked = parts_->running(pass, frame);
    if (linked == nullptr || !linked->pass.instances_of)
        throw Error(fmt::format("pass {} draws nothing in frame {}", pass, frame));
    return parts_->picture(*linked, frame, how);
}

/// Binds the buffer with the counts and returns their place in it; nothing where they are beyond what GL can dispatch:
/// then as many groups run as the items take.
std::optional<GLintptr> GlSystem::Parts::group_counts(const GroupCounts& of) {
    constexpr std::uint32_t most_groups = 65535; // that every GL has
    for (std::size_t s = 0; s < storages.size(); ++s) {
        if (storages[s].layout.resource != of.field.resource)
            continue;
        std::size_t words = 0;
        for (const RecordLayout::Member& member : storages[s].layout.members) {
            const Field& field = storages[s].layout.field(member);
            if (member.field == of.field.field) {
                const std::size_t place = of.item * storages[s].layout.bytes() + words * sizeof(std::uint32_t);
                const std::array<std::uint32_t, 3> counts = from(s).three_words(place);
                gl::BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, from(s).id());
                const bool fits = std::all_of(counts.begin(), counts.end(), [](auto n) { return n <= most_groups; });
                return fits ? std::optional(static_cast<GLintptr>(place)) : std::nullopt;
            }
            words += static_cast<std::size_t>(field.components);
        }
    }
    return {};
}

void GlSystem::Parts::dispatch(const Linked& linked, int frame) {
    using Kind = Bound::Kind;
    linked.program.check_interface();
    const auto is_copied = [&](std::uint8_t resource) { return kept || !in_place(resource); };
    for (std::size_t s = 0; s < storages.size(); ++s)
        if ((!storages[s].block.empty() || linked.pass.keeps()) && is_copied(storages[s].layout.resource) &&
            std::count(linked.resources.begin(), linked.resources.end(), storages[s].layout.resource) > 0)
            to(s).copy(from(s));
    std::vector<GlBuffer> given; // lives until the dispatch is done
    for (std::size_t b = 0; b < linked.bound.size(); ++b) {
        const Bound& bound = linked.bound[b];
        GLuint buffer = 0;
        if (bound.kind == Kind::data) {
            std::vector<float> floats = linked.pass.data.at(bound.name)(frame);
            floats.resize(std::max<std::size_t>(floats.size(), 1));
            buffer = given.emplace_back().id();
            gl::BindBuffer(GL_COPY_READ_BUFFER, buffer);
            gl::BufferData(GL_COPY_READ_BUFFER, static_cast<GLsizeiptr>(floats.size() * sizeof(float)), floats.data(),
                           GL_STREAM_DRAW);
        } else {
            const std::uint8_t resource = storages[bound.storage].layout.resource;
            const bool written = std::count(linked.resources.begin(), linked.resources.end(), resource) > 0;
            const bool after =
                bound.kind == Kind::after || (bound.kind == Kind::in_place && written && is_copied(resource));
            buffer = (after ? to(bound.storage) : from(bound.storage)).id();
        }
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(b), buffer);
    }
    std::vector<const RecordBuffer*> read, written;
    for (std::size_t s = 0; s < storages.size(); ++s)
        if (storages[s].block.empty()) {
            read.push_back(&from(s));
            written.push_back(&to(s));
        }
    linked.by_member.fill(read, written);
    const std::size_t items =
        linked.pass.invocations ? linked.pass.invocations(frame) : this->items(linked.pass.resource);
    // Negative: as many groups as the items take.
    const GLintptr place = linked.pass.indirect ? group_counts(*linked.pass.indirect).value_or(-1) : -1;
    linked.program.use();
    timed([&] {
        if (place >= 0)
            gl::DispatchComputeIndirect(place);
        else if (is_image(linked.pass.resource) && !linked.pass.invocations)
            dispatch_image(linked);
        else
            gl::DispatchCompute(static_cast<GLuint>((items + linked.invocations - 1) / linked.invocations), 1, 1);
    });
    linked.by_member.collect(written);
    gl::BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    gl::MemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                      GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                      GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void GlSystem::Parts::dispatch_image(const Linked& linked) {
    const Extent& extent = image_to(linked.pass.resource).extent();
    const auto groups = [&](std::size_t texels, int axis) {
        const std::size_t of = linked.group[static_cast<std::size_t>(axis)];
        return static_cast<GLuint>((texels + of - 1) / of);
    };
    gl::DispatchCompute(groups(extent.width, 0), groups(extent.height, 1), groups(extent.depth, 2));
}

void GlSystem::Parts::run(const Linked& linked, int frame) {
    const std::uint8_t resource = linked.pass.resource;
    set_uniforms(linked.program, linked.pass, items(resource), frame);
    lend_images(linked.program, linked.pass);
    if (linked.pass.stage == Stage::compute && is_image(resource)) {
        const bool words = linked.pass.writes_words;
        for (std::size_t i = 0; i < linked.resources.size(); ++i) {
            StateImage& after = image_to(linked.resources[i]);
            if (linked.pass.invocations)
                after.copy(image_from(linked.resources[i]));
            const Resource& about = schema->resources[linked.resources[i]];
            linked.program.set_unit("u_" + shader_name(about.name) + "After", static_cast<int>(i),
                                    words ? GL_UNSIGNED_INT_IMAGE_3D : image_type(about));
            gl::BindImageTexture(static_cast<GLuint>(i), after.id(), 0, GL_TRUE, 0,
                                 linked.pass.invocations ? GL_READ_WRITE : GL_WRITE_ONLY,
                                 words ? GL_R32UI : after.format().layout.internal);
        }
    }
    if (linked.pass.draw)
        draw(linked);
    else if (linked.pass.stage == Stage::vertex)
        capture(linked);
    else
        dispatch(linked, frame);
    gl::UseProgram(0);
    gl::Finish();
    check_gl(linked.pass.name);
    if (takes_times) // a buffer that is read may be moved to where kernels are slow
        return;
    for (std::size_t s = 0; s < storages.size(); ++s)
        for (const RecordBuffer& buffer : buffers[s])
            if (!buffer.spare_holds(canary_word))
                throw Error(
                    fmt::format("frame {}: {} wrote behind the {} {}s of {}; right is to return from item {} on", frame,
                                linked.pass.name, buffer.size(), storages[s].layout.about().item, storages[s].block,
                                buffer.size()));
}

void GlSystem::Parts::step(std::size_t pass, int frame, bool keeps) {
    const Linked* linked = running(pass, frame);
    if (linked == nullptr)
        return;
    kept = keeps ? std::optional(pass) : std::nullopt;
    run(*linked, frame);
    for (const std::uint8_t r : linked->resources)
        if (keeps || !in_place(r))
            current[r] = 1 - current[r];
}

void GlSystem::step(std::size_t pass, int frame) {
    parts_->step(pass, frame, std::exchange(parts_->canary_laid, std::nullopt) == pass);
}

void GlSystem::repeat_step(std::size_t pass, int frame) {
    const Parts::Linked* linked = parts_->running(pass, frame);
    if (linked == nullptr)
        return;
    const bool in_place = std::any_of(linked->resources.begin(), linked->resources.end(),
                                      [&](std::uint8_t r) { return parts_->in_place(r); });
    if (in_place && parts_->kept != pass)
        throw Error(
            fmt::format("{}: changed its state in place; right is lay_canary before a step that is to be repeated",
                        linked->pass.name));
    for (const std::uint8_t r : linked->resources)
        parts_->current[r] = 1 - parts_->current[r];
    parts_->step(pass, frame, true);
}

void GlSystem::lay_canary(std::size_t pass) {
    parts_->canary_laid = pass;
    if (const std::optional<Parts::Linked>& linked = parts_->passes.at(pass);
        linked && parts_->is_image(linked->pass.resource))
        for (const std::uint8_t r : linked->resources)
            parts_->image_to(r).fill(canary_word);
    else if (linked)
        for (std::size_t s = 0; s < parts_->storages.size(); ++s)
            if (parts_->storages[s].layout.resource == linked->pass.resource)
                parts_->to(s).fill(canary_word);
}

void GlSystem::read(SystemState& state) const {
    for (const auto& [resource, two] : parts_->images)
        two[parts_->current[resource]].read(state[resource]);
    for (std::size_t s = 0; s < parts_->storages.size(); ++s)
        parts_->from(s).read(state[parts_->storages[s].layout.resource]);
}

std::optional<bool> GlSystem::holds(const View& state) const {
    if (parts_->is_image(state.resource))
        return {};
    std::vector<const RecordBuffer*> buffers;
    for (std::size_t s = 0; s < parts_->storages.size(); ++s)
        if (parts_->storages[s].layout.resource == state.resource)
            buffers.push_back(&parts_->from(s));
    return hold_numbers(buffers, state);
}

std::vector<CapturedVertex> GlSystem::trace(std::size_t pass, int frame, std::size_t item) {
    if (parts_->running(pass, frame) == nullptr || parts_->passes[pass]->pass.stage != Stage::vertex ||
        parts_->passes[pass]->pass.instances_of || parts_->passes[pass]->pass.draw)
        return {};
    Parts::Linked& linked = *parts_->passes[pass];
    if (!linked.traced) {
        const std::vector<ShaderSource> stages = parts_->sources(linked.pass, std::array{linked.pass.stage}, true);
        const std::vector<Capture> outputs = outputs_with("trace_", stages);
        linked.traced = outputs.empty() ? std::vector<VertexCapture>{}
                                        : vertex_captures("trace build of " + linked.pass.name, stages, outputs);
    }
    // What the pass wrote is what it read the last time.
    const RecordBuffer& source = parts_->to(parts_->first_storage(linked.pass.resource));
    CapturedVertex all;
    parts_->target.bind();
    gl::Enable(GL_RASTERIZER_DISCARD);
    for (const VertexCapture& part : *linked.traced) {
        set_uniforms(part.program(), linked.pass, source.size(), frame);
        parts_->lend_images(part.program(), linked.pass);
        const CapturedVertex one = part.run(source, item, 1).front();
        all.outputs.insert(all.outputs.end(), one.outputs.begin(), one.outputs.end());
    }
    gl::Disable(GL_RASTERIZER_DISCARD);
    return {all};
}

} // namespace lockstep
