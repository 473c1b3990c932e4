#include "gpu/bound_storage.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/glsl_type.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t);

std::string resource_name(GLuint program, GLenum interface, GLuint index) {
    std::array<char, 512> name{};
    gl::GetProgramResourceName(program, interface, index, static_cast<GLsizei>(name.size()), nullptr, name.data());
    return name.data();
}

/// "particles.place" of "Particles.particles[0].place": without the block, which instances have before it.
std::string member_name(std::string name, const std::string& block) {
    for (std::size_t at = name.find('['); at != std::string::npos; at = name.find('['))
        name.erase(at, name.find(']', at) - at + 1);
    return name.starts_with(block + ".") ? name.substr(block.size() + 1) : name;
}

bool is_named(const std::string& member, const std::string& name) {
    return member == name || member.ends_with("." + name);
}

Scalar scalar_of(GLenum type) {
    if (is_float_type(type))
        return Scalar::float32;
    return type == GL_UNSIGNED_INT || type == GL_UNSIGNED_INT_VEC2 || type == GL_UNSIGNED_INT_VEC3 ||
                   type == GL_UNSIGNED_INT_VEC4
               ? Scalar::uint32
               : Scalar::int32;
}

std::uint32_t constant(double number, GLenum type) {
    switch (scalar_of(type)) {
    case Scalar::float32:
        return std::bit_cast<std::uint32_t>(static_cast<float>(number));
    case Scalar::uint32:
        return static_cast<std::uint32_t>(number);
    case Scalar::int32:
        break;
    }
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(number));
}

std::vector<std::uint32_t> content(GLuint buffer, std::size_t words) {
    std::vector<std::uint32_t> all(words);
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer);
    gl::GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(words * word), all.data());
    return all;
}

std::vector<std::uint32_t> content(const RecordBuffer& buffer) {
    return content(buffer.id(), buffer.size() * buffer.layout().bytes() / word);
}

} // namespace

BoundStorage::BoundStorage(GLuint program, std::shared_ptr<const Bindings> bindings, std::vector<RecordBlocks> ours)
    : bindings_(std::move(bindings)), ours_(std::move(ours)) {
    if (bindings_ == nullptr)
        return;
    for (std::size_t o = 0; o < ours_.size(); ++o)
        add_names(o);
    GLint count = 0;
    gl::GetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint b = 0; b < static_cast<GLuint>(count); ++b) {
        const std::string name = resource_name(program, GL_SHADER_STORAGE_BLOCK, b);
        const auto bound = bindings_->storage_blocks.find(name);
        if (bound != bindings_->storage_blocks.end() && bound->second.ours.empty())
            add_block(program, b, name, bound->second);
    }
    if (!blocks_.empty())
        check_written();
}

void BoundStorage::add_names(std::size_t ours) {
    const RecordBlocks& blocks = ours_[ours];
    for (const auto& [prefix, kind] : {std::pair{blocks.before + ".", Word::Kind::before},
                                       {blocks.after + ".", Word::Kind::after},
                                       {std::string(), Word::Kind::in_place}}) {
        std::size_t place = 0;
        for (const RecordLayout::Member& member : blocks.layout->members) {
            const Field& field = blocks.layout->field(member);
            names_.push_back({prefix + field.name, kind, ours, place, field.scalar, field.components, true});
            for (int c = 0; c < field.components && field.components > 1; ++c)
                names_.push_back({fmt::format("{}{}.{}", prefix, field.name, "xyzw"[c]), kind, ours,
                                  place + static_cast<std::size_t>(c), field.scalar, 1, false});
            place += static_cast<std::size_t>(field.components);
        }
    }
}

bool BoundStorage::has(std::string_view block) const {
    return std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& one) { return one.name == block; });
}

BoundStorage::Member BoundStorage::member_of(GLuint program, GLuint variable) const {
    constexpr std::array<GLenum, 6> properties{
        GL_TYPE, GL_OFFSET, GL_ARRAY_SIZE, GL_ARRAY_STRIDE, GL_TOP_LEVEL_ARRAY_SIZE, GL_TOP_LEVEL_ARRAY_STRIDE};
    std::array<GLint, 6> values{};
    gl::GetProgramResourceiv(program, GL_BUFFER_VARIABLE, variable, static_cast<GLsizei>(properties.size()),
                             properties.data(), static_cast<GLsizei>(values.size()), nullptr, values.data());
    const bool in_records = values[5] > 0; // an array of structures; else perhaps one of plain values
    Member member;
    member.type = static_cast<GLenum>(values[0]);
    member.offset = static_cast<std::size_t>(values[1]) / word;
    member.stride = static_cast<std::size_t>(in_records ? values[5] : values[3]) / word;
    member.elements = static_cast<std::size_t>(in_records ? values[4] : values[2]);
    return member;
}

void BoundStorage::add_block(GLuint program, GLuint block, const std::string& name,
                             const StorageBlockBinding& binding) {
    const auto fail = [&](const std::string& path, const std::string& what) {
        throw Error(fmt::format("{}: {}: {}", bindings_->file, path, what));
    };
    GLint binding_point = 0, variables = 0;
    const GLenum point = GL_BUFFER_BINDING, number = GL_NUM_ACTIVE_VARIABLES, all = GL_ACTIVE_VARIABLES;
    gl::GetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, block, 1, &point, 1, nullptr, &binding_point);
    gl::GetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, block, 1, &number, 1, nullptr, &variables);
    std::vector<GLint> indices(static_cast<std::size_t>(variables));
    gl::GetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, block, 1, &all, variables, nullptr, indices.data());

    Block& made = blocks_.emplace_back();
    made.name = name;
    made.binding = static_cast<GLuint>(binding_point);
    std::vector<std::string> names;
    for (const GLint index : indices) {
        Member member = member_of(program, static_cast<GLuint>(index));
        member.name = member_name(resource_name(program, GL_BUFFER_VARIABLE, static_cast<GLuint>(index)), name);
        names.push_back(member.name.substr(member.name.rfind('.') + 1));
        const auto bound = std::find_if(binding.members.begin(), binding.members.end(),
                                        [&](const auto& one) { return is_named(member.name, one.first); });
        if (bound == binding.members.end())
            fail(binding.path, fmt::format("nothing is given for its member {} {}; right is a name here, or a number",
                                           type_name(member.type), names.back()));
        member.path = bound->second.path;
        add_words(member, bound->second);
        made.members.push_back(std::move(member));
    }
    for (const auto& [theirs, given] : binding.members)
        if (std::none_of(made.members.begin(), made.members.end(),
                         [&](const Member& member) { return is_named(member.name, theirs); }))
            fail(given.path, fmt::format("block {} has no member {}; it has {}{}", name, theirs, fmt::join(names, ", "),
                                         did_you_mean(theirs, names)));
}

void BoundStorage::add_words(Member& member, const UniformBinding& binding) {
    const auto fail = [&](const std::string& what) {
        throw Error(fmt::format("{}: {}: {}", bindings_->file, binding.path, what));
    };
    const auto wanted = static_cast<std::size_t>(output_components(member.type));
    if (wanted == 0)
        fail(fmt::format("is {}; what can be bound is a number or a vector of up to four", type_name(member.type)));
    for (const double number : binding.numbers) {
        if (!is_float_type(member.type) && number != std::nearbyint(number))
            fail(fmt::format("{} is no {}", number, type_name(member.type)));
        member.words.push_back({Word::Kind::constant, 0, 0, constant(number, member.type)});
    }
    for (const std::string& name : binding.names) {
        if (name == "count") {
            member.words.push_back({Word::Kind::count});
            continue;
        }
        const auto found =
            std::find_if(names_.begin(), names_.end(), [&](const Name& one) { return one.name == name; });
        if (found == names_.end()) {
            std::vector<std::string> known{"count"};
            for (const Name& one : names_)
                if (one.whole)
                    known.push_back(one.name);
            fail(fmt::format("{} is nothing here; right is one of {}{}", name, fmt::join(known, ", "),
                             did_you_mean(name, known)));
        }
        if (found->scalar != scalar_of(member.type))
            fail(fmt::format("{} is {}, but {} is {}", name,
                             type_name(gl_type({.name = {}, .scalar = found->scalar, .components = found->components})),
                             member.name, type_name(member.type)));
        for (int c = 0; c < found->components; ++c)
            member.words.push_back({found->kind, found->ours, found->place + static_cast<std::size_t>(c)});
        if (found->kind != Word::Kind::after)
            reads_.insert(found->ours);
        if (found->kind != Word::Kind::before)
            writes_.insert(found->ours);
    }
    if (member.words.size() != wanted)
        fail(fmt::format("{} value{} for a {}", member.words.size(), member.words.size() == 1 ? "" : "s",
                         type_name(member.type)));
    const bool of_items = std::any_of(member.words.begin(), member.words.end(), [](const Word& one) {
        return one.kind != Word::Kind::constant && one.kind != Word::Kind::count;
    });
    if (of_items && member.stride == 0)
        fail(fmt::format("{} is no array, but {} has a value for each item", member.name,
                         fmt::join(binding.names, ", ")));
}

/// Each buffer that is written has all of its fields written, each once.
void BoundStorage::check_written() const {
    for (const std::size_t o : writes_) {
        std::map<std::size_t, int> written;
        for (const Block& block : blocks_)
            for (const Member& member : block.members)
                for (const Word& one : member.words)
                    if (one.ours == o && (one.kind == Word::Kind::after || one.kind == Word::Kind::in_place))
                        ++written[one.place];
        std::size_t at = 0;
        for (const RecordLayout::Member& member : ours_[o].layout->members) {
            const Field& field = ours_[o].layout->field(member);
            for (int c = 0; c < field.components; ++c, ++at)
                if (written[at] != 1)
                    throw Error(fmt::format("{}: /storage_blocks: {}.{} is written by {}; right is one",
                                            bindings_->file, ours_[o].after, field.name,
                                            written[at] == 0 ? "no member" : "more than one member"));
        }
    }
}

std::size_t BoundStorage::words_in(const Block& block, std::size_t items) const {
    std::size_t words = 1;
    for (const Member& member : block.members) {
        if (member.stride > 0 && member.elements > 0 && member.elements < items)
            throw Error(fmt::format("{}: {}: {} has {} elements for {} items", bindings_->file, member.path,
                                    member.name, member.elements, items));
        const std::size_t last = member.stride == 0 ? 0 : std::max(items, member.elements) - (items > 0 ? 1 : 0);
        words = std::max(words, member.offset + last * member.stride + std::max<std::size_t>(member.stride, 4));
    }
    return words;
}

void BoundStorage::fill(std::span<const RecordBuffer* const> before, std::span<const RecordBuffer* const> after) const {
    if (blocks_.empty())
        return;
    std::vector<std::vector<std::uint32_t>> from(ours_.size()), to(ours_.size());
    for (std::size_t o = 0; o < ours_.size(); ++o) {
        if (reads(o))
            from[o] = content(*before[o]);
        if (writes(o))
            to[o] = content(*after[o]);
    }
    for (const Block& block : blocks_) {
        std::size_t items = 0;
        for (const Member& member : block.members)
            for (const Word& one : member.words)
                if (one.kind != Word::Kind::constant)
                    items = std::max(items, before[one.ours]->size());
        std::vector<std::uint32_t> words(words_in(block, items));
        for (const Member& member : block.members)
            for (std::size_t item = 0; item < (member.stride == 0 ? 1 : std::max(items, member.elements)); ++item)
                for (std::size_t c = 0; c < member.words.size(); ++c) {
                    const Word& one = member.words[c];
                    const std::size_t each = ours_[one.ours].layout->bytes() / word;
                    std::uint32_t& into = words[member.offset + item * member.stride + c];
                    if (one.kind == Word::Kind::constant)
                        into = one.bits;
                    else if (one.kind == Word::Kind::count)
                        into = static_cast<std::uint32_t>(before.front()->size());
                    else if (item < before[one.ours]->size())
                        into = (one.kind == Word::Kind::after ? to : from)[one.ours][item * each + one.place];
                }
        gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, block.buffer.id());
        gl::BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(words.size() * word), words.data(),
                       GL_DYNAMIC_COPY);
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, block.binding, block.buffer.id());
    }
}

void BoundStorage::collect(std::span<const RecordBuffer* const> after) const {
    if (writes_.empty())
        return;
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (const std::size_t o : writes_) {
        const std::size_t items = after[o]->size(), each = ours_[o].layout->bytes() / word;
        std::vector<std::uint32_t> records(items * each);
        for (const Block& block : blocks_) {
            std::optional<std::vector<std::uint32_t>> words;
            for (const Member& member : block.members)
                for (std::size_t c = 0; c < member.words.size(); ++c) {
                    const Word& one = member.words[c];
                    if (one.ours != o || (one.kind != Word::Kind::after && one.kind != Word::Kind::in_place))
                        continue;
                    if (!words)
                        words = content(block.buffer.id(), words_in(block, items));
                    for (std::size_t item = 0; item < items; ++item)
                        records[item * each + one.place] = (*words)[member.offset + item * member.stride + c];
                }
        }
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, after[o]->id());
        gl::BufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(records.size() * word), records.data());
    }
}

} // namespace lockstep
