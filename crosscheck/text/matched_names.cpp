#include "crosscheck/text/matched_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/text/made_up_inputs.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::string_view stage_name(spv::ExecutionModel stage) {
    return stage == spv::ExecutionModelVertex     ? "vertex"
           : stage == spv::ExecutionModelGeometry ? "geometry"
           : stage == spv::ExecutionModelFragment ? "fragment"
                                                  : "compute";
}

std::string_view kind_of(const text::Block& block) { return block.is_storage ? "storage block" : "uniform block"; }
std::string_view kind_of(const text::ImageUniform& image) { return image.is_storage ? "image" : "sampler"; }

std::string_view number_name(bool is_real) { return is_real ? "float" : "integer"; }

/// "4 floats", "1 integer".
std::string numbers(std::size_t count, bool is_real) {
    return fmt::format("{} {}{}", count, number_name(is_real), count == 1 ? "" : "s");
}

/// Two texts whose interfaces have to be one; by a host, as far as both have them.
class Interfaces {
  public:
    Interfaces(const StageText& text, const StageText& reference, bool by_host)
        : text_(text), reference_(reference), by_host_(by_host) {}
    [[nodiscard]] bool by_host() const { return by_host_; }

    /// Of `found` in the text, what the reference has is expected.
    [[noreturn]] void refuse(std::string_view found, std::string_view expected) const {
        throw Error(fmt::format("{}: {}; expected {}, as {} has", text_.file, found, expected, reference_.file));
    }
    void check_stage() const {
        const text::Program &a = text_.program, &b = reference_.program;
        if (a.stage != b.stage)
            refuse(fmt::format("a {} stage", stage_name(a.stage)), fmt::format("a {} stage", stage_name(b.stage)));
        if (a.group != b.group && !by_host_)
            refuse(fmt::format("local_size {}", fmt::join(a.group, ", ")),
                   fmt::format("local_size {}", fmt::join(b.group, ", ")));
    }
    /// By a host they are one buffer, whatever it is declared as.
    void check_block(const text::Block& own, const text::Block& expected) const {
        if (by_host_)
            return;
        const std::string name = fmt::format("{} {}", kind_of(own), own.name);
        if (own.array_stride != expected.array_stride || own.array_offset != expected.array_offset)
            refuse(fmt::format("{}: {}", name, array_of(own)), array_of(expected));
        check_leaves(name, own.leaves, expected.leaves);
        check_leaves(name + ", an element", own.element, expected.element);
    }
    void check_image(const text::ImageUniform& own, const text::ImageUniform& expected) const {
        const auto shape = [](const text::ImageUniform& of) {
            return std::array<std::uint32_t, 4>{of.shape.dimensions, of.shape.format, of.shape.is_arrayed,
                                                of.shape.has_samples};
        };
        if (own.is_storage != expected.is_storage)
            refuse(fmt::format("{} {}", kind_of(own), own.name), fmt::format("{} {}", kind_of(expected), own.name));
        if (shape(own) != shape(expected) || own.is_real != expected.is_real || own.is_signed != expected.is_signed)
            refuse(fmt::format("{} {} of another type", kind_of(own), own.name), "the same dimensions and format");
    }
    /// A uniform, an input or an output.
    template <class Variable>
    void check_variable(std::string_view kind, const Variable& own, const Variable& expected) const {
        if (own.cells != expected.cells || own.is_real != expected.is_real || own.is_boolean != expected.is_boolean)
            refuse(fmt::format("{} {} of {}", kind, own.name, numbers(own.cells, own.is_real)),
                   numbers(expected.cells, expected.is_real));
    }
    /// One of the texts lacks what the other has.
    void refuse_missing(bool is_in_reference, std::string_view kind, std::string_view name) const {
        if (by_host_)
            return;
        const auto [with, without] = is_in_reference ? std::pair(&reference_, &text_) : std::pair(&text_, &reference_);
        throw Error(
            fmt::format("{}: no {} {}; expected one of this name, as {} has", without->file, kind, name, with->file));
    }

  private:
    static std::string array_of(const text::Block& block) {
        return block.array_stride == 0 ? std::string("no array without a length")
                                       : fmt::format("an array without a length of {} bytes an element, from byte {}",
                                                     block.array_stride, block.array_offset);
    }
    void check_leaves(std::string_view name, const std::vector<text::Leaf>& own,
                      const std::vector<text::Leaf>& expected) const {
        for (std::size_t k = 0; k < std::min(own.size(), expected.size()); ++k)
            if (own[k].word != expected[k].word || own[k].is_real != expected[k].is_real)
                refuse(fmt::format("{}: number {} is the {} of word {}", name, k, number_name(own[k].is_real),
                                   own[k].word),
                       fmt::format("the {} of word {}", number_name(expected[k].is_real), expected[k].word));
        if (own.size() != expected.size())
            refuse(fmt::format("{}: {} numbers", name, own.size()), fmt::format("{}", expected.size()));
    }

    const StageText& text_;
    const StageText& reference_;
    bool by_host_;
};

std::vector<std::optional<std::size_t>> matched_blocks(const Interfaces& both, const std::vector<text::Block>& own,
                                                       const std::vector<text::Block>& expected) {
    std::vector<std::optional<std::size_t>> matched(expected.size());
    std::vector<bool> is_taken(own.size());
    const auto match = [&](const auto& are_alike) {
        for (std::size_t e = 0; e < expected.size(); ++e)
            for (std::size_t o = 0; !matched[e] && o < own.size(); ++o)
                if (!is_taken[o] && own[o].is_storage == expected[e].is_storage && are_alike(own[o], expected[e])) {
                    matched[e] = o;
                    is_taken[o] = true;
                }
    };
    match([](const text::Block& a, const text::Block& b) { return a.name == b.name; });
    match([](const text::Block& a, const text::Block& b) { return a.binding && a.binding == b.binding; });
    for (std::size_t e = 0; e < expected.size(); ++e)
        if (matched[e])
            both.check_block(own[*matched[e]], expected[e]);
        else if (expected[e].name != block_of_uniforms)
            both.refuse_missing(true, kind_of(expected[e]), expected[e].name);
    for (std::size_t o = 0; o < own.size(); ++o)
        if (!is_taken[o] && own[o].name != block_of_uniforms)
            both.refuse_missing(false, kind_of(own[o]), own[o].name);
    const auto are_one = [](const text::Block& a, const text::Block& b) {
        return a.binding && a.binding == b.binding && a.is_storage == b.is_storage;
    };
    for (std::size_t a = 0; a < expected.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (matched[a] && matched[b] && !both.by_host() &&
                are_one(expected[a], expected[b]) != are_one(own[*matched[a]], own[*matched[b]]))
                both.refuse(fmt::format("blocks {} and {} {} one buffer", own[*matched[b]].name, own[*matched[a]].name,
                                        are_one(expected[a], expected[b]) ? "are not" : "are"),
                            are_one(expected[a], expected[b]) ? "one binding" : "two bindings");
    return matched;
}

/// Which of `own` each of `expected` is, by name(one). Calls check(own, expected) of both, and missing(whether it is
/// one of `expected`, it) of what only one side has.
template <class Variable, class Name, class Check, class Missing>
std::vector<std::optional<std::size_t>> matched_by_name(const std::vector<Variable>& own,
                                                        const std::vector<Variable>& expected, const Name& name,
                                                        const Check& check, const Missing& missing) {
    std::vector<std::optional<std::size_t>> matched;
    const auto place_in = [&](const std::vector<Variable>& all, const Variable& one) {
        return static_cast<std::size_t>(
            std::ranges::find_if(all, [&](const Variable& other) { return name(other) == name(one); }) - all.begin());
    };
    for (const Variable& one : expected) {
        const std::size_t place = place_in(own, one);
        matched.push_back(place == own.size() ? std::nullopt : std::optional(place));
        if (matched.back())
            check(own[place], one);
        else
            missing(true, one);
    }
    for (const Variable& one : own)
        if (place_in(expected, one) == expected.size())
            missing(false, one);
    return matched;
}

} // namespace

MatchedNames matched_names(const Examination& of, const StageText& text, const StageText& reference, bool by_host) {
    const Interfaces both(text, reference, by_host);
    const text::Program &own = text.program, &expected = reference.program;
    both.check_stage();
    const auto name = [](const auto& one) { return one.name; };
    const auto name_or_location = [](const text::StageVariable& one) { return text::name_of(one); };
    const auto name_of_output = [&](const text::StageVariable& one) {
        const std::string whole = text::name_of(one);
        const std::size_t part = whole.rfind('.') + 1, prefix = whole.find('_', part);
        return !by_host || one.builtin || prefix == std::string::npos ? whole.substr(by_host ? part : 0)
                                                                      : whole.substr(prefix + 1);
    };
    MatchedNames names{.blocks = matched_blocks(both, own.blocks, expected.blocks), .images = {}, .outputs = {}};
    names.images = matched_by_name(
        own.images, expected.images, name, [&](const auto& a, const auto& b) { both.check_image(a, b); },
        [&](bool is_in_reference, const text::ImageUniform& one) {
            both.refuse_missing(is_in_reference, kind_of(one), one.name);
        });
    names.outputs = matched_by_name(
        own.stage_outputs, expected.stage_outputs, name_of_output,
        [&](const auto& a, const auto& b) { both.check_variable("output", a, b); },
        [&](bool is_in_reference, const text::StageVariable& one) {
            both.refuse_missing(is_in_reference, "output", text::name_of(one));
        });
    matched_by_name(
        own.stage_inputs, expected.stage_inputs, name_or_location,
        [&](const auto& a, const auto& b) { both.check_variable("input", a, b); },
        [&](bool is_in_reference, const text::StageVariable& one) {
            if (one.is_read && !one.builtin)
                both.refuse_missing(is_in_reference, "input", text::name_of(one));
        });
    matched_by_name(
        own.uniforms, expected.uniforms, name,
        [&](const auto& a, const auto& b) { both.check_variable("uniform", a, b); },
        [&](bool is_in_reference, const text::PlainUniform& one) {
            if (!by_host && !of.uniforms.contains(one.name))
                throw Error(fmt::format("{}: uniform {} is in this text alone; expected its value, --uniform {}=...",
                                        (is_in_reference ? reference : text).file, one.name, one.name));
        });
    return names;
}

std::optional<text::WrittenPlace> MatchedNames::place(const StageText& text, const StageText& reference,
                                                      text::WrittenPlace place) const {
    using Space = text::WrittenPlace::Space;
    if (place.is_of_block()) {
        if (!blocks[place.number])
            return {};
        place.number = static_cast<std::uint32_t>(*blocks[place.number]);
    } else if (place.is_of_image()) {
        if (!images[place.number])
            return {};
        place.number = static_cast<std::uint32_t>(*images[place.number]);
    } else if (place.space == Space::output) {
        for (std::size_t o = 0; o < outputs.size(); ++o)
            if (const text::StageVariable& one = reference.program.stage_outputs[o];
                place.word >= one.cell && place.word < one.cell + one.cells) {
                if (!outputs[o])
                    return {};
                place.word += text.program.stage_outputs[*outputs[o]].cell;
                place.word -= one.cell;
                return place;
            }
        return {};
    }
    return place;
}

MadeUpWorld world_of_reference(const Examination& of, const MatchedNames& names, const StageText& text,
                               const StageText& reference, const MadeUpWorld& world, const MadeUpWorld* own_world) {
    const text::Program& program = reference.program;
    MadeUpWorld made;
    made.words.reserve(program.blocks.size() + program.images.size());
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
        std::vector<std::uint32_t>& words =
            made.words.emplace_back(names.blocks[b]        ? world.words[*names.blocks[b]]
                                    : own_world != nullptr ? own_world->words[b]
                                                           : std::vector<std::uint32_t>(program.blocks[b].words(0)));
        give_members(of, program.blocks[b], words);
        made.bindings.blocks.emplace_back(words);
    }
    for (std::size_t b = 0; b < program.blocks.size(); ++b) // several may have one's words
        if (names.blocks[b]) {
            const auto from = std::find(names.blocks.begin(), names.blocks.end(),
                                        std::optional(world.words_of_block(*names.blocks[b])));
            made.bindings.blocks[b] = made.words[static_cast<std::size_t>(from - names.blocks.begin())];
        }
    for (std::size_t i = 0; i < program.images.size(); ++i) {
        const std::optional<std::size_t> from = names.images[i];
        if (!from && own_world == nullptr)
            throw Error(fmt::format("{}: {} {} is bound to nothing", reference.file, kind_of(program.images[i]),
                                    program.images[i].name));
        text::TexelMemory texels = from ? world.bindings.images[*from] : own_world->bindings.images[i];
        texels.name = program.images[i].name;
        texels.words = made.words.emplace_back(from ? world.words[text.program.blocks.size() + *from]
                                                    : own_world->words[program.blocks.size() + i]);
        made.bindings.images.push_back(texels);
    }
    made.bindings.uniforms = given_uniforms(of, program);
    return made;
}

text::StageRun run_of_reference(const Examination& of, const StageText& reference, const text::StageRun& run) {
    text::StageRun made = run;
    made.inputs = made_up_run(of, reference.program).inputs;
    for (const text::StageVariable& input : reference.program.stage_inputs) {
        const auto found = made.inputs.find(text::name_of(input));
        if (found == made.inputs.end())
            continue;
        if (const auto own = run.inputs.find(found->first); own != run.inputs.end())
            found->second = own->second;
        else if (found->second.size() > input.words()) // made up for whole quads
            found->second.resize(std::size_t{run.invocations} * input.words());
    }
    return made;
}

} // namespace lockstep
