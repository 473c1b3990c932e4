#include "crosscheck/text/pass_text.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/text/glsl_module.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "gpu/gl_system_blocks.hpp"
#include "gpu/spirv_module.hpp"
#include "gpu/state_image.hpp"
#include "reference/model/error.hpp"
#include "reference/text/accesses.hpp"

namespace lockstep {
namespace {

std::shared_ptr<const ShaderSource> source_of(const GlPass& pass, const ShaderFolders& folders,
                                              ArithmeticSwitch arithmetic) {
    const StageInput input = stage_input(pass, arithmetic);
    if (pass.draws_vertices())
        throw Error(fmt::format("{}: a pass that draws is not interpreted", pass.name));
    const std::array stages{pass.stage};
    return std::make_shared<ShaderSource>(load_stages(folders, pass.name, stages, input.defines, input.texts).front());
}

/// The items of a view as records: the words of each component, one after the other.
std::vector<std::uint32_t> records_of(const View& view, std::span<const Component> record) {
    std::vector<std::uint32_t> words(view.count() * record.size());
    for (std::size_t k = 0; k < record.size(); ++k)
        for (std::size_t item = 0; item < view.count() && record[k] != no_component; ++item)
            words[item * record.size() + k] = view.value(record[k].field, item, record[k].component).bits;
    return words;
}

void set_items(const WritableView& view, std::span<const Component> record, std::span<const std::uint32_t> words) {
    for (std::size_t k = 0; k < record.size(); ++k) {
        if (record[k] == no_component)
            continue;
        const auto components = static_cast<std::size_t>(view.fields()[record[k].field].components);
        std::byte* const column = view.columns[record[k].field];
        for (std::size_t item = 0; item < view.count(); ++item)
            std::memcpy(column + (item * components + static_cast<std::size_t>(record[k].component)) * sizeof words[0],
                        &words[item * record.size() + k], sizeof words[0]);
    }
}

bool is_real(const UniformValue& value) {
    return std::visit(
        []<class T>(const T&) {
            if constexpr (std::is_arithmetic_v<T>)
                return std::is_floating_point_v<T>;
            else
                return std::is_floating_point_v<typename T::value_type>;
        },
        value);
}

std::vector<Component> texel_record(const Resource& image) {
    std::vector<Component> record;
    for (int c = 0; c < image.fields.front().components; ++c)
        record.push_back({0, c});
    return record;
}

} // namespace

std::vector<std::uint32_t> words_of(const UniformValue& value) {
    return std::visit(
        []<class T>(const T& v) {
            if constexpr (std::is_same_v<T, bool>)
                return std::vector<std::uint32_t>{v ? 1U : 0U};
            std::vector<std::uint32_t> words(sizeof v / sizeof(std::uint32_t));
            std::memcpy(words.data(), &v, sizeof v);
            return words;
        },
        value);
}

std::vector<std::uint32_t> words_given(const Uniforms& given, const text::PlainUniform& uniform) {
    if (const auto whole = given.find(uniform.name); whole != given.end())
        return words_of(whole->second);
    std::vector<std::uint32_t> words;
    for (std::size_t element = 0; words.size() < uniform.cells; ++element) {
        const auto one = given.find(fmt::format("{}[{}]", uniform.name, element));
        if (one == given.end())
            return {};
        const std::vector<std::uint32_t> more = words_of(one->second);
        words.insert(words.end(), more.begin(), more.end());
    }
    return words;
}

namespace {

/// A uniform block whose members have values by their names. One that has none keeps 0, as GL does.
std::vector<std::uint32_t> words_of_members(const text::Block& block, const Uniforms& given) {
    std::vector<std::uint32_t> words(block.words(0));
    for (const text::Block::Member& member : block.members) {
        const bool has_block = member.name.starts_with(block.name + ".");
        const std::vector<std::uint32_t> values =
            words_given(given, {.name = has_block ? member.name : block.name + "." + member.name,
                                .cells = static_cast<std::uint32_t>(member.leaves.size())});
        for (std::size_t k = 0; k < std::min(values.size(), member.leaves.size()); ++k)
            words[member.leaves[k].word] = values[k];
    }
    return words;
}

} // namespace

PassText::PassText(const Schema& schema, GlPass pass, std::vector<std::uint8_t> written, const ShaderFolders& folders,
                   ArithmeticSwitch arithmetic)
    : schema_(schema), pass_(std::move(pass)), written_(std::move(written)), arithmetic_(arithmetic),
      source_(source_of(pass_, folders, arithmetic)), program_(program_of(source_)) {
    if (source_->bindings != nullptr)
        refuse(fmt::format("a shader with {} beside it is not interpreted", bindings_file));
    for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
        const text::Block& block = program_.blocks[b];
        const bool has_members = std::ranges::find(pass_.uniform_blocks, block.name) != pass_.uniform_blocks.end();
        blocks_.push_back(has_members ? Bound{.kind = Bound::Kind::uniforms, .number = b} : block_named(block.name));
    }
    for (const text::ImageUniform& image : program_.images)
        images_.push_back(image_named(image.name));
    if (pass_.stage == Stage::fragment)
        capture_output();
    else if (is_per_item())
        capture();
}

void PassText::capture_output() {
    captured_.emplace(Bound{.kind = Bound::Kind::after, .resource = pass_.resource});
    std::vector<const text::StageVariable*> outputs;
    for (const text::StageVariable& output : program_.stage_outputs)
        if (!output.builtin)
            outputs.push_back(&output);
    const auto components = static_cast<std::uint32_t>(schema_.resources[pass_.resource].fields.front().components);
    if (outputs.size() != 1 || outputs.front()->cells < components)
        refuse(fmt::format("{} outputs; expected one, of {} components or more", outputs.size(), components));
    for (std::uint32_t c = 0; c < components; ++c) {
        captured_->record.push_back({0, static_cast<int>(c)});
        captured_cells_.push_back(
            {text::name_of(*outputs.front()), outputs.front()->cells, c, outputs.front()->cell + c});
    }
}

void PassText::capture() {
    captured_.emplace(Bound{.kind = Bound::Kind::after, .resource = pass_.resource});
    const std::vector<Field>& fields = schema_.resources[pass_.resource].fields;
    for (std::uint8_t f = 0; f < fields.size(); ++f) {
        const std::string name = "out_" + shader_name(fields[f].name);
        const auto output = std::ranges::find(program_.stage_outputs, name, &text::StageVariable::name);
        if (output == program_.stage_outputs.end())
            continue; // kept, or GlSystem says so
        if (output->cells != static_cast<std::uint32_t>(fields[f].components))
            refuse(fmt::format("output {} has {} components; expected {}", name, output->cells, fields[f].components));
        for (int c = 0; c < fields[f].components; ++c) {
            captured_->record.push_back({f, c});
            captured_cells_.push_back(
                {name, output->cells, static_cast<std::uint32_t>(c), output->cell + static_cast<std::uint32_t>(c)});
        }
    }
}

std::optional<std::size_t> PassText::captured_component(std::uint64_t cell) const {
    const auto found = std::ranges::find(captured_cells_, cell, &CapturedCell::cell);
    return found == captured_cells_.end() ? std::nullopt
                                          : std::optional(static_cast<std::size_t>(found - captured_cells_.begin()));
}

text::StageRun PassText::vertices(const PassInput& in) const {
    const auto count = static_cast<std::uint32_t>(items(in));
    text::StageRun run{.invocations = count};
    const std::uint8_t from = pass_.instances_of.value_or(pass_.resource);
    const auto instances = static_cast<std::uint32_t>(in.before[from].count());
    const std::uint32_t of_instance = pass_.instances_of && instances > 0 ? count / instances : 1;
    const Resource& about = schema_.resources[from];
    for (const text::StageVariable& input : program_.stage_inputs) {
        const auto number = [&](const auto& of) {
            std::vector<std::uint32_t>& words = run.inputs[text::name_of(input)];
            for (std::uint32_t vertex = 0; vertex < count; ++vertex)
                words.push_back(of(vertex));
        };
        if (input.builtin) {
            if (pass_.instances_of && input.name == "gl_VertexID")
                number([&](std::uint32_t vertex) { return vertex % of_instance; });
            if (pass_.instances_of && input.name == "gl_InstanceID")
                number([&](std::uint32_t vertex) { return vertex / of_instance; });
            continue;
        }
        const auto field =
            std::ranges::find(about.fields, input.name, [](const Field& one) { return "a_" + shader_name(one.name); });
        if (field == about.fields.end()) {
            if (!input.is_read)
                continue;
            refuse(fmt::format("nothing is given for attribute {}", input.name));
        }
        const auto f = static_cast<std::uint8_t>(field - about.fields.begin());
        if (input.words() != static_cast<std::uint32_t>(field->components))
            refuse(fmt::format("attribute {} has {} components; {} are given", input.name, input.words(),
                               field->components));
        std::vector<std::uint32_t>& words = run.inputs[text::name_of(input)];
        words.reserve(std::size_t{count} * input.words());
        for (std::uint32_t vertex = 0; vertex < count; ++vertex)
            for (int c = 0; c < field->components; ++c)
                words.push_back(in.before[from].value(f, vertex / of_instance, c).bits);
    }
    return run;
}

namespace {

/// Quads that cover a side.
std::uint32_t quads(std::size_t side) { return static_cast<std::uint32_t>((side + 1) / 2); }

} // namespace

std::uint32_t PassText::invocation_of(std::size_t item, const Extent& extent) const {
    if (pass_.stage != Stage::fragment)
        return static_cast<std::uint32_t>(item);
    const auto x = static_cast<std::uint32_t>(item % extent.width), y = static_cast<std::uint32_t>(item / extent.width);
    return 4 * (y / 2 * quads(extent.width) + x / 2) + 2 * (y % 2) + x % 2;
}

text::StageRun PassText::fragments(const PassInput& in) const {
    const Extent& extent = in.before[pass_.resource].extent;
    text::StageRun run{.invocations = 4 * quads(extent.width) * quads(extent.height), .are_quads = true};
    const auto give = [&](const text::StageVariable& input, const auto& coordinates) {
        std::vector<std::uint32_t>& words = run.inputs[text::name_of(input)];
        for (std::uint32_t number = 0; number < run.invocations; ++number) {
            const std::uint32_t quad = number / 4, x = 2 * (quad % quads(extent.width)) + number % 2,
                                y = 2 * (quad / quads(extent.width)) + number / 2 % 2;
            for (const float coordinate : coordinates(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F))
                words.push_back(std::bit_cast<std::uint32_t>(coordinate));
        }
    };
    const float across = 1.0F / static_cast<float>(extent.width), up = 1.0F / static_cast<float>(extent.height);
    for (const text::StageVariable& input : program_.stage_inputs) {
        const auto given = pass_.inputs.find(input.name);
        const bool is_given = given != pass_.inputs.end();
        if (input.builtin == spv::BuiltInFragCoord)
            give(input, [](float x, float y) { return std::array{x, y, 0.5F, 1.0F}; });
        else if (is_given && given->second == InputBy::uniform)
            run.inputs[text::name_of(input)] =
                words_given(this->given(in), {.name = input.name, .cells = input.cells, .is_real = input.is_real});
        else if (is_given && input.cells == 2)
            give(input, [&](float x, float y) { return std::array{x * across, y * up}; });
        else if (!input.builtin && input.is_read)
            refuse(
                fmt::format("nothing is given for input {}; expected gl_FragCoord, or a vec2 that is its place in the "
                            "image",
                            input.name));
    }
    return run;
}

std::vector<text::GivenInput> PassText::inputs_of(const Input& input, std::uint32_t number) const {
    return text::inputs_of(program_, input.stage, number);
}

void PassText::refuse(std::string_view what) const {
    throw Error(fmt::format("shader {}: {}", source_->files.front(), what));
}

bool PassText::is_text_of(const ShaderFolders& folders) const {
    const std::shared_ptr<const ShaderSource> other = source_of(pass_, folders, arithmetic_);
    if (source_->module == nullptr || other->module == nullptr)
        return source_->module == other->module && source_->text == other->text;
    return source_->module->words == other->module->words;
}

bool PassText::writes(std::uint8_t resource) const {
    return std::find(written_.begin(), written_.end(), resource) != written_.end();
}

PassText::Bound PassText::block_named(const std::string& name) const {
    const auto named = pass_.names.find(name);
    for (const SystemStorage& storage : storages_of(schema_)) {
        Bound bound{.kind = Bound::Kind::after, .resource = storage.layout.resource};
        if (named != pass_.names.end()) {
            if (bound.resource != named->second.resource)
                continue;
            if (storage.block.empty() && named->second.kind == GlName::Kind::before)
                bound.kind = Bound::Kind::before;
        } else if (storage.block.empty() && name == shader_name(storage.layout.about().name) + "Before") {
            bound.kind = Bound::Kind::before;
        } else if (name != block_of(schema_, storage, true)) {
            continue;
        }
        bound.record.assign(storage.layout.words(), no_component);
        storage.layout.for_each_member([&](const RecordLayout::Member& member, std::size_t first) {
            for (int c = 0; c < storage.layout.field(member).components; ++c)
                bound.record[first + static_cast<std::size_t>(c)] = {member.field, c};
        });
        return bound;
    }
    if (!pass_.data.contains(name))
        refuse(fmt::format("nothing is given for storage block {}", name));
    return {.kind = Bound::Kind::data, .name = name};
}

PassText::Bound PassText::image_named(const std::string& name) const {
    if (const auto named = pass_.names.find(name); named != pass_.names.end())
        return {.kind = named->second.kind == GlName::Kind::before ? Bound::Kind::before : Bound::Kind::after,
                .resource = named->second.resource,
                .record = texel_record(schema_.resources[named->second.resource])};
    for (std::uint8_t r = 0; r < schema_.resources.size(); ++r) {
        const std::string ours = "u_" + shader_name(schema_.resources[r].name);
        if (schema_.resources[r].dimensions > 1 && (name == ours + "Before" || name == ours + "After"))
            return {.kind = name == ours + "After" ? Bound::Kind::after : Bound::Kind::before,
                    .resource = r,
                    .record = texel_record(schema_.resources[r])};
    }
    refuse(fmt::format("nothing is given for image {}", name));
}

std::size_t PassText::items(const PassInput& in) const {
    return pass_.invocations ? pass_.invocations(in.frame) : in.before[pass_.resource].count();
}

std::array<std::uint32_t, 3> PassText::groups(const PassInput& in) const {
    constexpr std::uint32_t most_groups = 65535; // that every GL has (GlSystem)
    const auto over = [](std::size_t items, std::size_t of) {
        return static_cast<std::uint32_t>((items + of - 1) / of);
    };
    if (pass_.size)
        return {over((*pass_.size)[0], program_.group[0]), over((*pass_.size)[1], program_.group[1]),
                over((*pass_.size)[2], program_.group[2])};
    if (pass_.indirect) {
        std::array<std::uint32_t, 3> counts{};
        for (int c = 0; c < 3; ++c)
            counts[static_cast<std::size_t>(c)] = in.before.word(pass_.indirect->field, pass_.indirect->item, c);
        if (std::all_of(counts.begin(), counts.end(), [](std::uint32_t n) { return n <= most_groups; }))
            return counts;
    } else if (schema_.resources[pass_.resource].dimensions > 1 && !pass_.invocations) {
        const Extent& extent = in.before[pass_.resource].extent;
        return {over(extent.width, program_.group[0]), over(extent.height, program_.group[1]),
                over(extent.depth, program_.group[2])};
    }
    return {over(items(in), program_.invocations()), 1, 1};
}

Uniforms PassText::given(const PassInput& in) const {
    Uniforms all = pass_.uniforms ? pass_.uniforms(in.frame) : Uniforms{};
    all["u_ItemCount"] = static_cast<unsigned>(in.before[pass_.resource].count());
    return all;
}

std::vector<std::vector<std::uint32_t>> PassText::uniforms(const PassInput& in) const {
    const Uniforms given = this->given(in);
    std::vector<std::vector<std::uint32_t>> all;
    for (const text::PlainUniform& uniform : program_.uniforms) {
        all.push_back(words_given(given, uniform));
        if (const auto found = given.find(uniform.name);
            found != given.end() &&
            (all.back().size() != uniform.cells || (!uniform.is_boolean && uniform.is_real != is_real(found->second))))
            refuse(fmt::format("uniform {} has {} {}; {} {} are given", uniform.name, uniform.cells,
                               uniform.is_real ? "floats" : "integers", all.back().size(),
                               is_real(found->second) ? "floats" : "integers"));
    }
    return all;
}

PassText::Input PassText::bind(const PassInput& in, const Profile& profile) const {
    using Kind = Bound::Kind;
    Input input;
    std::vector<std::vector<std::uint32_t>>& words = input.words;
    for (const auto* const all : {&blocks_, &images_})
        for (const Bound& bound : *all)
            if (bound.kind == Kind::uniforms) {
                words.push_back(words_of_members(program_.blocks[bound.number], given(in)));
            } else if (bound.kind == Kind::data) {
                std::vector<float> floats = pass_.data.at(bound.name)(in.frame);
                floats.resize(std::max<std::size_t>(floats.size(), 1));
                words.emplace_back(floats.size());
                std::memcpy(words.back().data(), floats.data(), floats.size() * sizeof(float));
            } else {
                words.push_back(records_of(in.before[bound.resource], bound.record));
            }
    if (captured_)
        words.push_back(records_of(in.before[captured_->resource], captured_->record));
    text::Bindings& bindings = input.bindings;
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        bindings.blocks.emplace_back(words[b]);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const Extent& extent = in.before[images_[i].resource].extent;
        const ImageFormat format = image_format(schema_.resources[images_[i].resource]);
        using Code = text::TexelMemory::Code;
        using Filter = text::TexelMemory::Filter;
        const auto filter = pass_.filters.find(images_[i].resource);
        bindings.images.push_back({program_.images[i].name,
                                   {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height),
                                    static_cast<std::uint32_t>(extent.depth)},
                                   static_cast<std::uint32_t>(format.components),
                                   format.bytes == 1   ? Code::unorm8
                                   : format.bytes == 2 ? Code::half
                                                       : Code::number,
                                   filter == pass_.filters.end()        ? Filter::nearest
                                   : filter->second == GlFilter::linear ? Filter::linear
                                                                        : Filter::linear_in_black,
                                   words[blocks_.size() + i]});
    }
    bindings.uniforms = uniforms(in);
    for (const auto& [resource, filter] : pass_.filters)
        if (!profile.follows(schema_.resources[resource].dimensions == 2 ? "image: linear filter of a plane"
                                                                         : "image: linear filter"))
            refuse("this driver's linear filter is not followed");
    input.extent = in.before[pass_.resource].extent;
    if (is_per_item())
        input.stage = pass_.stage == Stage::fragment ? fragments(in) : vertices(in);
    else
        input.groups = groups(in);
    return input;
}

std::vector<std::size_t> PassText::words_of_resource(std::uint8_t resource) const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < bound_words(); ++k)
        if (bound(k).kind == Bound::Kind::after && bound(k).resource == resource && writes(resource))
            all.push_back(k);
    return all;
}

std::span<const Component> PassText::record(std::size_t words) const { return bound(words).record; }

void PassText::run(const PassInput& in, const Profile& profile, SystemState& after, text::Findings& findings,
                   const How& how) const {
    const Input input = bind(in, profile);
    std::vector<std::vector<std::uint32_t>> words = input.words;
    run_into(input, profile, findings, how, nullptr, words);
    for (std::size_t k = 0; k < words.size(); ++k)
        if (bound(k).kind == Bound::Kind::after && writes(bound(k).resource))
            set_items(after[bound(k).resource], bound(k).record, words[k]);
}

bool PassText::reads(std::uint8_t resource) const {
    const text::Accesses accesses = text::accesses_of(program_);
    const auto is_read = [&](const std::vector<Bound>& all, const std::vector<text::Access>& made) {
        for (std::size_t k = 0; k < all.size(); ++k)
            if (all[k].resource == resource && made[k].is_read &&
                (all[k].kind == Bound::Kind::before || all[k].kind == Bound::Kind::after))
                return true;
        return false;
    };
    return is_read(blocks_, accesses.blocks) || is_read(images_, accesses.images);
}

void PassText::run_into(const Input& input, const Profile& profile, text::Findings& findings, const How& how,
                        text::Writers* writers, std::vector<std::vector<std::uint32_t>>& to) const {
    text::Bindings bindings = input.bindings;
    for (std::size_t b = 0; b < bindings.blocks.size(); ++b)
        bindings.blocks[b] = to[b];
    for (std::size_t i = 0; i < bindings.images.size(); ++i)
        bindings.images[i].words = to[bindings.blocks.size() + i];
    if (!is_per_item()) {
        text::run_dispatch(program_,
                           {.groups = input.groups,
                            .wants = how.wants,
                            .is_watched = how.is_watched,
                            .writers = writers,
                            .coverage = how.coverage},
                           bindings, profile, findings);
        return;
    }
    if (how.is_watched || how.coverage != nullptr) {
        text::StageRun run = input.stage;
        run.is_watched = how.is_watched;
        run.coverage = how.coverage;
        run.keeps_outputs = false;
        if (how.wants)
            run.wants = [&](std::uint32_t first) { return how.wants({first / text::lanes_at_once, 0, 0}); };
        text::run_stage(program_, run, bindings, profile, findings);
        return;
    }
    const text::StageResult made = text::run_stage(program_, input.stage, bindings, profile, findings);
    std::vector<std::uint32_t>& words = to[blocks_.size() + images_.size()];
    for (std::size_t k = 0; k < captured_cells_.size(); ++k) {
        const CapturedCell& from = captured_cells_[k];
        const std::vector<std::uint32_t>& output = made.outputs.at(from.output);
        for (std::size_t item = 0; item * captured_cells_.size() < words.size(); ++item) {
            const std::size_t number = invocation_of(item, input.extent);
            if (made.is_discarded[number] == 0)
                words[item * captured_cells_.size() + k] = output[number * from.cells + from.component];
        }
    }
}

} // namespace lockstep
