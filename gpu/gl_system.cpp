#include "gpu/gl_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "gpu/gl_system_parts.hpp"
#include "gpu/nothing_given.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void check_stage(const GlPass& pass, const Schema& schema) {
    if (pass.stage == Stage::fragment && pass.draw && pass.resource < schema.resources.size() &&
        schema.resources[pass.resource].dimensions == 2)
        return;
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

} // namespace

void set_uniforms(const Program& program, const GlPass& pass, std::size_t items, int frame) {
    program.set("u_ItemCount", static_cast<unsigned>(items));
    if (pass.uniforms)
        for (const auto& [name, value] : pass.uniforms(frame))
            std::visit([&](const auto& v) { program.set(name, v); }, value);
}

void SystemSide::repeat_step(std::size_t /*pass*/, int /*frame*/) {
    throw Error(fmt::format("{}: says that it repeats a pass, but has no repeat_step", describe().name));
}

std::vector<CapturedVertex> SystemSide::trace(std::size_t /*pass*/, int /*frame*/, std::size_t /*item*/) { return {}; }

StageInput stage_input(const GlPass& pass, ArithmeticSwitch arithmetic) {
    ShaderDefines defines = arithmetic_defines(arithmetic);
    defines.insert(defines.end(), pass.defines.begin(), pass.defines.end());
    return {defines, pass.texts};
}

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
        if (pass.draws_vertices())
            used.push_back(Stage::fragment);
        const std::vector<ShaderSource> stages = parts_->sources(pass, used, false);
        const bool says = lockstep::says_precise(pass.stage == Stage::fragment ? stages.back() : stages.front());
        parts_->says_precise = parts_->says_precise && says;
        parts_->says_precise_once = parts_->says_precise_once || says;
        const std::vector<Capture> captures =
            captured ? parts_->storages[parts_->first_storage(pass.resource)].layout.captures()
                     : std::vector<Capture>{};
        Program program(pass.name, stages, captures);
        if (!compute)
            check_nothing_lost(stages, captures);
        std::vector<BoundBlock> bound;
        std::vector<bool> ends_with_last;
        BoundStorage by_member;
        std::array<GLint, 3> group{1, 1, 1};
        if (compute) {
            bound = bind_blocks(program, schema, parts_->storages, pass);
            ends_with_last = lengths_asked(program, bound.size());
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
                                                  sizes[0] * sizes[1] * sizes[2],
                                                  std::move(ends_with_last)});
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
    StageInput input = stage_input(pass, arithmetic);
    if (traced)
        input.defines.emplace_back("LOCKSTEP_TRACE", "1");
    std::vector<ShaderSource> all =
        load_stages(shader_folders(shaders, schema->system), pass.name, stages, input.defines, input.texts);
    if (pass.stage == Stage::fragment) {
        all.back().given = pass.inputs;
        all.insert(all.begin(), load_stage(shader_folders({}, {}), "full_screen", Stage::vertex));
    }
    if (!pass.uniform_blocks.empty())
        for (ShaderSource& stage : all) {
            Bindings bound = stage.bindings != nullptr ? *stage.bindings : Bindings{};
            bound.blocks.insert(bound.blocks.end(), pass.uniform_blocks.begin(), pass.uniform_blocks.end());
            stage.bindings = std::make_shared<const Bindings>(std::move(bound));
        }
    return all;
}

void GlSystem::upload(const SystemView& state) {
    std::size_t spare = 0; // records behind the last: what a last group could write
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
    for (const SystemStorage& storage : parts_->storages) {
        const std::uint8_t r = storage.layout.resource;
        std::vector<RecordBuffer>& two = parts_->buffers.emplace_back();
        for (int i = 0; i < 2; ++i) {
            two.emplace_back(storage.layout, state[r].count(), spare);
        }
        two[0].upload(state[r]);
    }
}

GlSystem::Seconds GlSystem::seconds() const { return parts_->seconds; }

bool GlSystem::says_precise() const { return parts_->says_precise; }
bool GlSystem::says_precise_once() const { return parts_->says_precise_once; }

void GlSystem::time_steps(bool on) { parts_->takes_times = on; }

ColorImage GlSystem::picture(std::size_t pass, int frame, const GlPicture& how) {
    const Parts::Linked* linked = parts_->running(pass, frame);
    if (linked == nullptr || !linked->pass.instances_of)
        throw Error(fmt::format("pass {} draws nothing in frame {}", pass, frame));
    return parts_->picture(*linked, frame, how);
}

void GlSystem::Parts::run(const Linked& linked, int frame) {
    const std::uint8_t resource = linked.pass.resource;
    set_uniforms(linked.program, linked.pass, items(resource), frame);
    lend_images(linked.program, linked.pass);
    if (linked.pass.stage == Stage::compute)
        bind_images(linked);
    if (linked.pass.draw)
        draw(linked);
    else if (linked.pass.stage == Stage::vertex)
        capture(linked);
    else
        dispatch(linked, frame);
    gl::UseProgram(0);
    gl::Finish();
    check_gl(linked.pass.name);
    if (!takes_times)
        check_ends(linked, fmt::format("frame {}: ", frame));
}

void GlSystem::Parts::bind_images(const Linked& linked) {
    GLuint unit = 0;
    const auto bind = [&](const std::string& name, GLenum type, StateImage& image, GLenum access, GLenum format) {
        linked.program.set_unit(name, static_cast<int>(unit), type);
        gl::BindImageTexture(unit++, image.id(), 0, GL_TRUE, 0, access, format);
    };
    std::set<std::uint8_t> named;
    for (const auto& [name, target] : linked.pass.names) {
        if (!is_image(target.resource) || target.is_sampler)
            continue;
        using enum GlName::Kind;
        if (target.kind != before && named.insert(target.resource).second && target.kind == in_place)
            image_to(target.resource).copy(image_from(target.resource));
        StateImage& image = target.kind == before ? image_from(target.resource) : image_to(target.resource);
        bind(name, image_type(schema->resources[target.resource]), image, GL_READ_WRITE,
             image.format().layout.internal);
    }
    const bool words = linked.pass.writes_words;
    for (const std::uint8_t resource : linked.resources) {
        if (!is_image(resource) || named.contains(resource))
            continue;
        StateImage& after = image_to(resource);
        if (linked.pass.invocations)
            after.copy(image_from(resource));
        const Resource& about = schema->resources[resource];
        bind("u_" + shader_name(about.name) + "After", words ? GL_UNSIGNED_INT_IMAGE_3D : image_type(about), after,
             linked.pass.invocations ? GL_READ_WRITE : GL_WRITE_ONLY,
             words ? GL_R32UI : after.format().layout.internal);
    }
}

void GlSystem::Parts::check_ends(const Linked& linked, const std::string& when) {
    for (std::size_t s = 0; s < storages.size(); ++s)
        if (linked.may_write(storages[s]) || linked.binds(s))
            for (const RecordBuffer* const buffer : {&from(s), &to(s)})
                check_margin(linked.program, buffer->range(block_of(*schema, storages[s], buffer == &to(s))), when);
}

void GlSystem::Parts::check_given(const Linked& linked) {
    try {
        linked.program.check_interface();
    } catch (const NothingGiven& missing) {
        if (linked.pass.advice.empty())
            throw;
        throw NothingGiven(missing.names, "; " + linked.pass.advice);
    }
}

void GlSystem::Parts::step(std::size_t pass, int frame, bool keeps) {
    const Linked* linked = running(pass, frame);
    ran_over.reset();
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
            fmt::format("{}: changed its state in place; right is lay_canary before a step that will be repeated",
                        linked->pass.name));
    for (const std::uint8_t r : linked->resources)
        parts_->current[r] = 1 - parts_->current[r];
    parts_->step(pass, frame, true);
}

std::optional<std::uint64_t> GlSystem::ran_over() const { return parts_->ran_over; }

void GlSystem::lay_canary(std::size_t pass) {
    parts_->canary_laid = pass;
    const std::optional<Parts::Linked>& linked = parts_->passes.at(pass);
    if (!linked)
        return;
    const bool of_images = parts_->is_image(linked->pass.resource);
    for (const std::uint8_t r : linked->resources)
        if (of_images && parts_->is_image(r))
            parts_->image_to(r).fill(canary_word);
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
        if (const RecordLayout& layout = parts_->storages[s].layout;
            layout.resource == state.resource &&
            std::ranges::any_of(layout.members, [&](const auto& member) { return state.columns[member.field]; }))
            buffers.push_back(&parts_->from(s));
    return hold_numbers(buffers, state);
}

std::optional<bool> GlSystem::left(const View& before) const {
    if (parts_->is_image(before.resource))
        return {};
    for (std::size_t s = 0; s < parts_->storages.size(); ++s)
        if (parts_->storages[s].layout.resource == before.resource && !parts_->to(s).holds(before))
            return false;
    return true;
}

bool GlSystem::reaches(std::size_t pass, FieldId field) const {
    const std::optional<Parts::Linked>& linked = parts_->passes.at(pass);
    if (!linked || linked->program.bindings() != nullptr) // blocks of other names
        return true;
    const bool is_made = std::ranges::find(linked->resources, field.resource) != linked->resources.end();
    if (is_made && !parts_->in_place(field.resource)) // the copies change places
        return true;
    return std::ranges::any_of(linked->bound, [&](const BoundBlock& bound) {
        return bound.kind != BoundBlock::Kind::data && parts_->storages[bound.storage].layout.has(field);
    });
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
