#include "gpu/bound_storage.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/glsl_type.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr std::size_t word_bytes = sizeof(std::uint32_t);

/// Whether a variable is an element of an array at the top of a block, behind its first, which some drivers list too.
bool is_later_element(std::string_view name, const std::string& block) {
    if (name.starts_with(block + "."))
        name.remove_prefix(block.size() + 1);
    const std::size_t bracket = name.find('[');
    return bracket < name.find('.') && bracket != std::string_view::npos && name.substr(bracket, 3) != "[0]";
}

/// "particles.place" of "Particles.particles[0].place", and "places" of "places[0]": without the block, which instances
/// have before it, and without the index of the item and of the last array.
std::string member_name(std::string name, const std::string& block) {
    if (name.ends_with("[0]"))
        name.resize(name.size() - 3);
    if (name.starts_with(block + "."))
        name.erase(0, block.size() + 1);
    const std::size_t first = name.find("[0].");
    if (first != std::string::npos && first < name.find('.'))
        name.erase(first, 3);
    return name;
}

bool is_named(const std::string& member, const std::string& name) {
    return member == name || member.ends_with("." + name);
}

/// A number, or a vector of up to four.
bool is_vector(GLenum type) {
    const int components = output_components(type);
    return components > 0 && components <= 4 && type != GL_FLOAT_MAT2;
}

std::vector<std::uint32_t> buffer_words(GLuint buffer, std::size_t count) {
    std::vector<std::uint32_t> all(count);
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer);
    gl::GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(count * word_bytes), all.data());
    return all;
}

std::vector<std::uint32_t> buffer_words(const RecordBuffer& buffer) {
    return buffer_words(buffer.id(), buffer.size() * buffer.layout().bytes() / word_bytes);
}

/// The invocations of a compute stage's group.
std::size_t group_of(const Program& program) {
    std::array<GLint, 3> size{1, 1, 1};
    gl::GetProgramiv(program.id(), GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
}

} // namespace

BoundStorage::BoundStorage(const Program& program, std::vector<RecordBlocks> ours)
    : bindings_(program.bindings()), writer_(fmt::format("{} ({})", program.name(), program.file())),
      group_(group_of(program)), ours_(std::move(ours)) {
    if (bindings_ == nullptr)
        return;
    for (std::size_t o = 0; o < ours_.size(); ++o)
        add_names(o);
    for (const InterfaceBlock& block : program.storage_blocks()) {
        const auto bound = bindings_->storage_blocks.find(block.name);
        if (bound != bindings_->storage_blocks.end() && bound->second.ours.empty())
            add_block(block, bound->second, program.asks_length(block));
    }
    check_written();
}

void BoundStorage::add_names(std::size_t ours) {
    const RecordBlocks& blocks = ours_[ours];
    std::vector<std::pair<std::string, Word::Kind>> prefixes{{blocks.before + ".", Word::Kind::before},
                                                             {blocks.after + ".", Word::Kind::after}};
    if (!blocks.both.empty())
        prefixes.emplace_back(blocks.both + ".", Word::Kind::in_place);
    if (ours_.size() == 1)
        prefixes.emplace_back("", Word::Kind::in_place);
    for (const auto& [prefix, kind] : prefixes) {
        const bool listed = !prefix.empty() || blocks.both.empty();
        std::size_t place = 0;
        for (const RecordLayout::Member& member : blocks.layout->members) {
            const Field& field = blocks.layout->field(member);
            names_.push_back({prefix + field.name, kind, ours, place, field.scalar, field.components, listed});
            for (int c = 0; c < field.components && field.components > 1; ++c)
                names_.push_back({fmt::format("{}{}.{}", prefix, field.name, "xyzw"[c]), kind, ours,
                                  place + static_cast<std::size_t>(c), field.scalar, 1, false});
            place += static_cast<std::size_t>(field.components);
        }
    }
}

void BoundStorage::add_block(const InterfaceBlock& block, const StorageBlockBinding& binding, bool ends_with_last) {
    const auto fail = [&](const std::string& path, const std::string& what) {
        throw Error(fmt::format("{}: {}: {}", bindings_->file, path, what));
    };
    const std::string& name = block.name;
    Block made{name, static_cast<GLuint>(block.binding), static_cast<std::size_t>(block.bytes) / word_bytes,
               ends_with_last};
    std::vector<std::string> names;
    std::map<std::string, std::string> taken; // the member by the file's name
    for (const BlockMember& variable : block.members) {
        if (is_later_element(variable.name, name))
            continue;
        const GLint step = variable.array_stride;
        const bool in_records = variable.top_level_stride > 0;
        Member member;
        member.name = member_name(variable.name, name);
        member.type = variable.type;
        member.offset = static_cast<std::size_t>(variable.offset) / word_bytes;
        member.stride = static_cast<std::size_t>(in_records ? variable.top_level_stride : step) / word_bytes;
        member.elements = static_cast<std::size_t>(in_records ? variable.top_level_size : variable.size);
        member.plain = !in_records && step > 0;
        if (in_records && step > 0) {
            member.parts = static_cast<std::size_t>(variable.size);
            member.part_words = static_cast<std::size_t>(step) / word_bytes;
        }
        names.push_back(member.name);
        const std::pair<const std::string, MemberBinding>* bound = nullptr;
        for (const auto& one : binding.members)
            if (is_named(member.name, one.first) && (bound == nullptr || one.first.size() > bound->first.size()))
                bound = &one;
        if (bound == nullptr)
            fail(binding.path, fmt::format("nothing is given for its member {} {}; right is a name here, or a number",
                                           type_name(member.type), member.name));
        if (const auto [other, first] = taken.emplace(bound->first, member.name); !first)
            fail(bound->second.path, fmt::format("{} and {} both have this name; right is the whole of it for each",
                                                 other->second, member.name));
        member.path = bound->second.path;
        add_words(member, bound->second);
        made.members.push_back(std::move(member));
    }
    for (const auto& [theirs, given] : binding.members)
        if (!taken.contains(theirs))
            fail(given.path, fmt::format("GL lists of block {} no {}member {}; it has {}{}", name,
                                         std::any_of(names.begin(), names.end(),
                                                     [&](const auto& one) { return is_named(one, theirs); })
                                             ? "other "
                                             : "",
                                         theirs, fmt::join(names, ", "), did_you_mean(theirs, names)));
    settle_counts(made, binding.path);
    blocks_.push_back(std::move(made));
}

void BoundStorage::add_words(Member& member, const MemberBinding& binding) {
    const auto fail = [&](const std::string& what) {
        throw Error(fmt::format("{}: {}: {}", bindings_->file, binding.path, what));
    };
    if (!is_vector(member.type))
        fail(fmt::format("{} is {}; right in a storage block here are numbers and vectors of float, int and uint",
                         member.name, type_name(member.type)));
    for (const std::variant<std::string, double>& value : binding.values) {
        if (std::holds_alternative<std::string>(value)) {
            add_name(member, binding.path, std::get<std::string>(value));
            continue;
        }
        const double number = std::get<double>(value);
        const std::optional<std::uint32_t> bits = word_of(number, member.type);
        if (!bits)
            fail(fmt::format("{} is no value of {}, which is {}; right is a whole number that it holds", number,
                             member.name, type_name(member.type)));
        member.words.push_back({Word::Kind::constant, 0, 0, *bits});
    }
    const auto each = static_cast<std::size_t>(output_components(member.type));
    if (member.plain && binding.is_list && member.words.size() > each && member.words.size() % each == 0) {
        member.parts = member.words.size() / each;
        member.part_words = std::exchange(member.stride, member.stride * member.parts);
        member.elements /= member.parts;
    }
    if (member.words.size() == 1 && !binding.is_list && member.words.front().kind == Word::Kind::constant)
        member.words.resize(each * member.parts, member.words.front());
    if (member.words.size() != each * member.parts)
        fail(fmt::format("{} value{} for {}, which is {}; right {} {}{}", member.words.size(),
                         member.words.size() == 1 ? "" : "s", member.name,
                         declared_type(member.type, static_cast<GLint>(member.parts)),
                         each * member.parts == 1 ? "is" : "are", each * member.parts,
                         member.plain && !binding.is_list ? ", or a list, as long as what each item has there" : ""));
    for (std::size_t c = 0; c < member.words.size(); ++c)
        member.words[c].at = c / each * member.part_words + c % each;
    const bool of_items = std::any_of(member.words.begin(), member.words.end(), [](const Word& one) {
        return one.kind != Word::Kind::constant && one.kind != Word::Kind::count;
    });
    if (of_items && member.stride == 0)
        fail(fmt::format("{} is no array, but has a field of each item; right is a number, or count", member.name));
}

void BoundStorage::add_name(Member& member, const std::string& path, const std::string& name) {
    const auto fail = [&](const std::string& what) {
        throw Error(fmt::format("{}: {}: {}", bindings_->file, path, what));
    };
    const Scalar wanted = scalar_of(member.type);
    if (name == "count") {
        member.words.push_back({.kind = Word::Kind::count, .as_float = wanted == Scalar::float32});
        return;
    }
    std::vector<std::string> known{"count"}, right{"count"};
    for (const Name& one : names_) {
        known.push_back(one.name);
        if (one.listed && one.scalar == wanted)
            right.push_back(one.name);
    }
    const auto found = std::find_if(names_.begin(), names_.end(), [&](const Name& one) { return one.name == name; });
    if (found == names_.end())
        fail(fmt::format("{} is nothing here; right is a number, or one of {}{}", name, fmt::join(right, ", "),
                         name.starts_with("u_") ? "; a uniform is bound in uniforms or uniform_blocks"
                                                : did_you_mean(name, known)));
    if (found->scalar != wanted)
        fail(fmt::format("{} is {}, but {} is {}; right is a number, or one of {}", name,
                         type_name(gl_type({.name = {}, .scalar = found->scalar, .components = found->components})),
                         member.name, type_name(member.type), fmt::join(right, ", ")));
    for (int c = 0; c < found->components; ++c)
        member.words.push_back({found->kind, found->ours, found->place + static_cast<std::size_t>(c)});
    if (found->kind != Word::Kind::after)
        reads_.insert(found->ours);
    if (found->kind != Word::Kind::before)
        writes_.insert(found->ours);
}

/// A count is of the one buffer whose fields the block has.
void BoundStorage::settle_counts(Block& block, const std::string& path) const {
    std::set<std::size_t> of;
    for (const Member& member : block.members)
        for (const Word& one : member.words)
            if (one.kind != Word::Kind::constant && one.kind != Word::Kind::count)
                of.insert(one.ours);
    if (of.empty() && ours_.size() == 1)
        of.insert(0);
    for (Member& member : block.members)
        for (Word& one : member.words) {
            if (one.kind != Word::Kind::count)
                continue;
            if (of.size() != 1)
                throw Error(fmt::format("{}: {}: count is of {} here; right is a block with the fields of one",
                                        bindings_->file, path, of.empty() ? "no buffer" : "several buffers"));
            one.ours = *of.begin();
        }
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
                    throw Error(fmt::format("{}: /storage_blocks: {}.{}{} is written by {}; right is one",
                                            bindings_->file, ours_[o].after, field.name,
                                            field.components == 1 ? "" : fmt::format(".{}", "xyzw"[c]),
                                            written[at] == 0 ? "no member" : "more than one member"));
        }
    }
}

/// Of the buffers whose fields it has; of all, where it has none.
std::size_t BoundStorage::items_of(const Block& block, std::span<const RecordBuffer* const> buffers) {
    std::optional<std::size_t> items;
    for (const Member& member : block.members)
        for (const Word& one : member.words)
            if (one.kind != Word::Kind::constant)
                items = std::max(items.value_or(0), buffers[one.ours]->size());
    if (!items)
        for (const RecordBuffer* buffer : buffers)
            items = std::max(items.value_or(0), buffer->size());
    return items.value_or(0);
}

/// So many that length() of an array without a size is the number of items.
std::size_t BoundStorage::words_of(const Block& block, std::size_t items) const {
    std::size_t words = std::max<std::size_t>(block.least, 1), base = words;
    for (const Member& member : block.members)
        if (member.stride > 0 && member.elements == 0)
            base = std::min(base, member.offset);
    for (const Member& member : block.members) {
        if (member.stride == 0)
            continue;
        if (member.elements == 0)
            words = std::max(words, base + items * member.stride);
        else if (member.elements < items)
            throw Error(fmt::format("{}: {}: {} has room for {} items of {}; right is an array of that length, or one "
                                    "without a size",
                                    bindings_->file, member.path, member.name, member.elements, items));
    }
    return words;
}

std::size_t BoundStorage::margin_words(const Block& block) const {
    std::size_t widest = 4;
    for (const Member& member : block.members)
        widest = std::max(widest, member.stride);
    return group_ * widest;
}

/// Words of `block` behind the last item, of members that have a state, and behind the block.
void BoundStorage::check_end(const Block& block, const std::vector<std::uint32_t>& words,
                             std::span<const RecordBuffer* const> buffers, std::string_view when) const {
    const std::size_t items = items_of(block, buffers), end = words_of(block, items);
    std::string_view item_name = "item";
    const auto fail = [&](const std::string& what, std::size_t count) {
        throw Error(fmt::format("{}{} wrote past the end of {} ({} {}{}); expected no write from item {} on", when,
                                writer_, what, count, item_name, count == 1 ? "" : "s", count));
    };
    for (const Member& member : block.members)
        for (const Word& one : member.words) {
            if (one.kind == Word::Kind::constant || one.kind == Word::Kind::count)
                continue;
            const RecordBuffer& of = *buffers[one.ours];
            item_name = of.layout().about().item;
            for (std::size_t item = of.size(); item < std::max(items, member.elements); ++item)
                if (words[member.offset + item * member.stride + one.at] != margin_word)
                    fail(fmt::format("{}, {}", block.name, member.name), of.size());
        }
    if (std::any_of(words.begin() + static_cast<std::ptrdiff_t>(end), words.end(),
                    [](std::uint32_t one) { return one != margin_word; }))
        fail(block.name, items);
}

void BoundStorage::fill(std::span<const RecordBuffer* const> before, std::span<const RecordBuffer* const> after) const {
    std::vector<std::vector<std::uint32_t>> from(ours_.size()), to(ours_.size());
    for (const std::size_t o : reads_)
        from[o] = buffer_words(*before[o]);
    for (const std::size_t o : writes_)
        to[o] = buffer_words(*after[o]);
    const auto value = [&](const Word& one, std::size_t item) -> std::uint32_t {
        if (one.kind == Word::Kind::constant)
            return one.bits;
        const std::size_t size = before[one.ours]->size();
        if (one.kind == Word::Kind::count)
            return one.as_float ? std::bit_cast<std::uint32_t>(static_cast<float>(size))
                                : static_cast<std::uint32_t>(size);
        const std::size_t each = ours_[one.ours].layout->bytes() / word_bytes;
        return item < size ? (one.kind == Word::Kind::after ? to : from)[one.ours][item * each + one.place]
                           : margin_word;
    };
    for (const Block& block : blocks_) {
        const std::size_t items = items_of(block, before), end = words_of(block, items);
        std::vector<std::uint32_t> words(end);
        words.resize(end + margin_words(block), margin_word);
        for (const Member& member : block.members)
            for (std::size_t item = 0; item < (member.stride == 0 ? 1 : std::max(items, member.elements)); ++item)
                for (const Word& one : member.words)
                    words[member.offset + item * member.stride + one.at] = value(one, item);
        gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, block.buffer.id());
        gl::BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(words.size() * word_bytes), words.data(),
                       GL_DYNAMIC_COPY);
        const StorageRange range{block.name, "", 1, end * word_bytes, {block.buffer.id(), 0, 0}};
        range.bind(block.binding, block.ends_with_last);
    }
}

void BoundStorage::collect(std::span<const RecordBuffer* const> after, std::string_view when) const {
    if (blocks_.empty())
        return;
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<std::vector<std::uint32_t>> records(ours_.size());
    for (const std::size_t o : writes_)
        records[o].resize(after[o]->size() * ours_[o].layout->bytes() / word_bytes);
    for (const Block& block : blocks_) {
        const std::vector<std::uint32_t> words =
            buffer_words(block.buffer.id(), words_of(block, items_of(block, after)) + margin_words(block));
        check_end(block, words, after, when);
        for (const Member& member : block.members)
            for (const Word& one : member.words) {
                if (one.kind != Word::Kind::after && one.kind != Word::Kind::in_place)
                    continue;
                const std::size_t each = ours_[one.ours].layout->bytes() / word_bytes;
                for (std::size_t item = 0; item < after[one.ours]->size(); ++item)
                    records[one.ours][item * each + one.place] = words[member.offset + item * member.stride + one.at];
            }
    }
    for (const std::size_t o : writes_) {
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, after[o]->id());
        gl::BufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(records[o].size() * word_bytes),
                          records[o].data());
    }
}

std::vector<bool> lengths_asked(const Program& program, std::size_t points) {
    std::vector<bool> asked(points);
    for (const InterfaceBlock& block : program.storage_blocks())
        if (static_cast<std::size_t>(block.binding) < points)
            asked[static_cast<std::size_t>(block.binding)] = program.asks_length(block);
    return asked;
}

std::vector<StorageBlock> storage_blocks(const Program& program, std::span<const std::string> ours) {
    const Bindings* const bindings = program.bindings().get();
    std::vector<StorageBlock> all;
    for (const InterfaceBlock& block : program.storage_blocks()) {
        const std::string& name = block.name;
        const StorageBlockBinding* binding = nullptr;
        if (bindings != nullptr)
            if (const auto found = bindings->storage_blocks.find(name); found != bindings->storage_blocks.end())
                binding = &found->second;
        if (binding != nullptr && !binding->ours.empty() &&
            std::find(ours.begin(), ours.end(), binding->ours) == ours.end())
            throw Error(fmt::format("{}: {}: {} is no storage block here; right is one of {}{}", bindings->file,
                                    binding->path, binding->ours, fmt::join(ours, ", "),
                                    did_you_mean(binding->ours, {ours.begin(), ours.end()})));
        all.push_back({name, binding != nullptr ? binding->ours : name, binding != nullptr});
    }
    return all;
}

BoundStorage bind_storage(const Program& program, std::span<const std::string> ours, std::size_t reserved,
                          const RecordBlocks& records) {
    const auto fail = [&](const std::string& name, const std::string& what) {
        throw Error(fmt::format("{}: nothing is given for storage block {}{}; {} beside the shader binds it by name "
                                "(docs/own_shader.md), or layout(binding = 0) to {} does",
                                program.name(), name, what, bindings_file, ours.size() - 1));
    };
    const std::vector<StorageBlock> blocks = storage_blocks(program, ours);
    const bool any_bound = std::any_of(blocks.begin(), blocks.end(), [](const StorageBlock& b) { return b.bound; });
    std::map<GLint, std::string> at; // of those that keep their points
    auto next_point = static_cast<GLuint>(reserved);
    for (GLuint block = 0; block < static_cast<GLuint>(blocks.size()); ++block) {
        const StorageBlock& one = blocks[block];
        if (one.bound) {
            const auto whole = std::find(ours.begin(), ours.end(), one.ours);
            gl::ShaderStorageBlockBinding(program.id(), block,
                                          one.ours.empty() ? next_point++ : static_cast<GLuint>(whole - ours.begin()));
            continue;
        }
        const GLint point = storage_binding(program.id(), block);
        if (static_cast<std::size_t>(point) >= reserved)
            fail(one.name, fmt::format(" at binding {}", point));
        if (point == 0 && any_bound && one.name != ours.front())
            fail(one.name, fmt::format(", which has no binding of its own but {}'s", ours.front()));
        if (const auto [other, first] = at.emplace(point, one.name); !first)
            fail(one.name, fmt::format(" at binding {}, where {} is", point, other->second));
    }
    return {program, {records}};
}

} // namespace lockstep
