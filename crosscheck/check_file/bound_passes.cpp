#include "crosscheck/check_file/bound_passes.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/check_file/shader_text.hpp"
#include "crosscheck/check_file/uniform_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "gpu/old_glsl.hpp"
#include "gpu/state_image.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep::check_file {
namespace {

/// A pass with its text.
struct TextOfPass : ShaderText {
    TextOfPass(const PassEntry& pass, ShaderText&& text) : ShaderText(std::move(text)), entry(pass) {}
    const PassEntry& entry;
};

/// A name of a shader's, the entry that it is bound to, and what the shader does with it.
struct Use {
    std::string name;
    std::size_t entry = 0;
    text::Access access;
    bool is_sampler = false;
    bool is_output = false; ///< of a fragment stage
};

class Binder {
  public:
    Binder(const Document& document, const std::filesystem::path& shaders) : document_(document) {
        const ShaderFolders folders = shader_folders(shaders, system_name);
        for (const PassEntry& entry : document.passes)
            texts_.emplace_back(entry, shader_text(folders, entry.name, entry.stage));
        records_.resize(document.state.size());
        for (const TextOfPass& text : texts_)
            uses_.push_back(uses_of(text));
        for (std::size_t e = 0; e < document.state.size(); ++e)
            check_bound(e);
    }

    BoundPasses bound() {
        BoundPasses made{std::make_shared<const Schema>(schema()), {}};
        UnusedNames unused(document_.uniforms);
        for (std::size_t p = 0; p < texts_.size(); ++p)
            add_pass(p, unused, made.passes);
        unused.check("no pass has a uniform of this name");
        return made;
    }

  private:
    /// Keys of an object, and whether each was taken by some shader.
    class UnusedNames {
      public:
        explicit UnusedNames(const std::optional<JsonValue>& names) : names_(names) {
            if (names)
                for (const std::string& name : names->keys())
                    left_.insert(name);
        }
        /// The value of a name, where it is there.
        std::optional<JsonValue> take(const std::string& name) {
            known_.insert(name);
            left_.erase(name);
            return names_ ? names_->find(name) : std::nullopt;
        }
        void check(const std::string& what) const {
            if (!left_.empty())
                names_->at(*left_.begin())
                    .fail(fmt::format("{}; expected {}{}", what,
                                      known_.empty() ? "none" : fmt::format("one of {}", fmt::join(known_, ", ")),
                                      did_you_mean(*left_.begin(), {known_.begin(), known_.end()})));
        }

      private:
        const std::optional<JsonValue>& names_;
        std::set<std::string> left_, known_;
    };

    [[nodiscard]] std::vector<std::string> entry_names() const {
        std::vector<std::string> names;
        for (const StateEntry& entry : document_.state)
            names.push_back(entry.name);
        return names;
    }

    /// The entry of the state that a name of a shader's goes to.
    [[nodiscard]] std::size_t entry_of(const TextOfPass& text, const std::string& name, std::string_view kind) const {
        const std::vector<std::string> names = entry_names();
        const auto bound = text.entry.bind.find(name);
        const std::string wanted = bound == text.entry.bind.end() ? name : bound->second.text();
        const auto found = std::find(names.begin(), names.end(), wanted);
        if (found != names.end())
            return static_cast<std::size_t>(found - names.begin());
        if (bound != text.entry.bind.end())
            bound->second.fail(fmt::format("'{}' is no entry of the state; there are {}{}", plain_line(wanted),
                                           fmt::join(names, ", "), did_you_mean(wanted, names)));
        text.entry.place.fail(fmt::format("nothing is bound to {} {} of {}; expected \"bind\": {{ \"{}\": one of {} }}",
                                          kind, name, text.file, name, fmt::join(names, ", ")));
    }

    std::vector<Use> uses_of(const TextOfPass& text) {
        std::vector<Use> uses;
        std::set<std::string> known;
        for (std::size_t b = 0; b < text.program.blocks.size(); ++b) {
            const text::Block& block = text.program.blocks[b];
            if (!block.is_storage)
                continue;
            known.insert(block.name);
            const std::size_t e = entry_of(text, block.name, "storage block");
            const StateEntry& entry = document_.state[e];
            if (entry.dimensions != 1)
                entry.place.fail(fmt::format("is an image, but {} has it as a storage block, {}; expected count",
                                             text.file, block.name));
            take_record(e, text, block);
            uses.push_back({block.name, e, text.accesses.blocks[b]});
        }
        for (std::size_t i = 0; i < text.program.images.size(); ++i) {
            const text::ImageUniform& image = text.program.images[i];
            known.insert(image.name);
            const std::size_t e = entry_of(text, image.name, image.is_storage ? "image" : "sampler");
            const StateEntry& entry = document_.state[e];
            if (entry.dimensions == 1)
                entry.place.fail(fmt::format("is a buffer, but {} has it as an image, {}; expected size and format",
                                             text.file, image.name));
            if (const std::string format = format_of(image).name;
                image.is_storage && image.shape.format != spv::ImageFormatUnknown && format != entry.format)
                entry.place.at("format").fail(fmt::format("is {}, but {} declares {} as {}", plain_line(entry.format),
                                                          text.file, image.name, format.empty() ? "another" : format));
            uses.push_back({image.name, e, text.accesses.images[i], !image.is_storage});
        }
        if (text.entry.stage == Stage::fragment)
            add_output(text, uses, known);
        for (const auto& [name, value] : text.entry.bind)
            if (!known.contains(name))
                value.fail(fmt::format("{} has no storage block, sampler or image {}{}", text.file, plain_line(name),
                                       did_you_mean(name, {known.begin(), known.end()})));
        return uses;
    }

    /// What a full-screen pass writes: its output alone.
    void add_output(const TextOfPass& text, std::vector<Use>& uses, std::set<std::string>& known) const {
        for (const Use& use : uses)
            if (use.access.is_written || document_.state[use.entry].dimensions == 1)
                text.entry.place.fail(
                    fmt::format("{} has {} beside its output; expected samplers alone", text.file, use.name));
        check_inputs(text);
        for (const text::StageVariable& output : text.program.stage_outputs) {
            if (output.builtin)
                continue;
            const std::string name = old_name(output.name);
            known.insert(name);
            const std::size_t e = entry_of(text, name, "output");
            const StateEntry& entry = document_.state[e];
            if (entry.dimensions != 2 || entry.format.find("32") == std::string::npos)
                entry.place.fail(fmt::format(
                    "is what {} of {} draws; expected an image of two sides in a format of 32 bits", name, text.file));
            uses.push_back({name, e, {.is_written = true}, false, true});
        }
    }

    static bool is_place(const JsonValue& input) { return input.is_text() && input.choice({"uv"}) == 0; }

    /// Each that the text reads is given, as its place in the image or by a value.
    static void check_inputs(const TextOfPass& text) {
        std::set<std::string> known;
        for (const text::StageVariable& input : text.program.stage_inputs) {
            if (input.builtin)
                continue;
            known.insert(input.name);
            const auto given = text.entry.inputs.find(input.name);
            const bool is_vec2 = input.is_real && input.cells == 2 && input.components == 2;
            if (given != text.entry.inputs.end()) {
                if (is_place(given->second) && !is_vec2)
                    given->second.fail(
                        fmt::format("{} of {} is no vec2, as a place in the image is", input.name, text.file));
                if (!is_place(given->second) && (!input.is_real || input.name.find('.') != std::string::npos))
                    given->second.fail(fmt::format(
                        "{} of {} is an integer, or in a block; expected a float, vector or matrix of its own",
                        input.name, text.file));
            } else if (input.is_read) {
                text.entry.place.fail(fmt::format(
                    "nothing is given for input {0} of {1}; expected \"inputs\": {{ "
                    "\"{0}\": {2}",
                    input.name, text.file, is_vec2 ? "\"uv\" }, its place in the image, or a value" : "value }"));
            }
        }
        for (const auto& [name, value] : text.entry.inputs)
            if (!known.contains(name))
                value.fail(fmt::format("{} has no input {}{}", text.file, plain_line(name),
                                       did_you_mean(name, {known.begin(), known.end()})));
    }

    void take_record(std::size_t e, const TextOfPass& text, const text::Block& block) {
        Record record = record_of(block, text.file);
        const StateEntry& entry = document_.state[e];
        if (record.fields.empty())
            entry.place.fail(fmt::format(
                "block {} has members beside an array without a size; expected the array alone", record.declared));
        if (record.count != 0 && record.count != entry.extent.width)
            entry.place.fail(
                fmt::format("count is {}, but {} holds {}", entry.extent.width, record.declared, record.count));
        Record& known = records_[e];
        if (known.fields.empty()) {
            known = std::move(record);
            return;
        }
        if (!known.is_like(record))
            entry.place.fail(
                fmt::format("{} and {} declare other records; expected one layout", known.declared, record.declared));
    }

    void check_bound(std::size_t e) const {
        const auto is_used = [&](const std::vector<Use>& uses) {
            return std::ranges::any_of(uses, [&](const Use& use) { return use.entry == e; });
        };
        if (std::ranges::none_of(uses_, is_used))
            document_.state[e].place.fail(
                "no pass has it; expected a block, sampler or image of this name, or \"bind\"");
    }

    /// Whether some pass has it as a block or image that is only read, and another that is written.
    [[nodiscard]] bool is_in_two_copies(std::size_t e) const {
        return std::ranges::any_of(uses_, [&](const std::vector<Use>& uses) {
            bool is_written = false, is_only_read = false;
            for (const Use& use : uses)
                if (use.entry == e) {
                    is_written = is_written || use.access.is_written;
                    is_only_read = is_only_read || !use.access.is_written;
                }
            return is_written && is_only_read;
        });
    }

    [[nodiscard]] Schema schema() const {
        Schema made{std::string(system_name), {}};
        std::map<std::string, int> times; // a field's name stands there once
        for (const Record& record : records_)
            for (const Field& field : record.fields)
                ++times[field.name];
        for (const StateEntry& entry : document_.state)
            if (entry.dimensions > 1)
                ++times[entry.name];
        for (std::size_t e = 0; e < document_.state.size(); ++e) {
            const StateEntry& entry = document_.state[e];
            Resource resource{.name = entry.name,
                              .item = entry.name + (entry.dimensions == 1 ? " item" : " texel"),
                              .title = entry.name,
                              .fields = {},
                              .dimensions = entry.dimensions,
                              .format = entry.format};
            if (entry.dimensions == 1) {
                resource.record_words = records_[e].words;
                for (Field field : records_[e].fields) {
                    if (times[field.name] > 1)
                        field.name = entry.name + "_" + field.name;
                    if (!is_in_two_copies(e))
                        field.block = entry.name;
                    resource.fields.push_back(std::move(field));
                }
            } else {
                resource.fields.push_back(texel_field(entry));
            }
            made.resources.push_back(std::move(resource));
        }
        try {
            return checked(std::move(made));
        } catch (const Error& error) {
            document_.state.front().place.fail(error.what());
        }
    }

    /// What a texel of the format has. Throws Error where there is no such format.
    static Field texel_field(const StateEntry& entry) {
        const std::string& format = entry.format;
        Field field{.name = entry.name};
        field.components = format.starts_with("rgba") || format.starts_with("srgb8") ? 4
                           : format.starts_with("rg")                                ? 2
                                                                                     : 1;
        field.scalar = format.ends_with('f')     ? Scalar::float32
                       : format.ends_with("32i") ? Scalar::int32
                                                 : Scalar::uint32;
        try {
            static_cast<void>(image_format({.name = entry.name,
                                            .item = "texel",
                                            .title = entry.name,
                                            .fields = {field},
                                            .dimensions = entry.dimensions,
                                            .format = format}));
        } catch (const Error& error) {
            entry.place.at("format").fail(error.what());
        }
        return field;
    }

    void add_pass(std::size_t p, UnusedNames& of_all, std::vector<GlPass>& to) const {
        const TextOfPass& text = texts_[p];
        GlPass pass{.name = text.entry.name, .stage = text.entry.stage};
        std::set<std::size_t> written;
        for (const Use& use : uses_[p]) {
            const bool is_alone = std::ranges::count(uses_[p], use.entry, &Use::entry) == 1;
            if (!use.is_output)
                pass.names[use.name] = {static_cast<std::uint8_t>(use.entry),
                                        !use.access.is_written ? GlName::Kind::before
                                        : is_alone             ? GlName::Kind::in_place
                                                               : GlName::Kind::after,
                                        use.is_sampler};
            if (use.access.is_written && !written.insert(use.entry).second)
                text.entry.place.fail(fmt::format("{} writes {} through two names; expected one", text.file,
                                                  document_.state[use.entry].name));
            if (use.is_sampler && document_.state[use.entry].filter)
                pass.filters[static_cast<std::uint8_t>(use.entry)] = *document_.state[use.entry].filter;
        }
        if (written.empty())
            text.entry.place.fail(fmt::format("{} writes no entry of the state", text.file));
        if (pass.stage == Stage::fragment)
            pass.draw = GlDraw{.primitive = GlDraw::Primitive::triangles, .clears = false, .vertices = 3, .once = true};
        if (text.entry.groups) {
            pass.size = *text.entry.groups;
            for (std::size_t axis = 0; axis < 3; ++axis)
                (*pass.size)[axis] *= text.program.group[axis];
        }
        if (text.entry.invocations)
            pass.invocations = [count = *text.entry.invocations](int) { return count; };
        for (const auto& [name, value] : text.entry.inputs)
            pass.inputs[name] = is_place(value) ? InputBy::place : InputBy::uniform;
        pass.advice = "\"uniforms\" of the check file gives it";
        set_uniforms(text, of_all, pass);
        for (const std::size_t e : written) {
            if (e == *written.begin()) {
                pass.resource = static_cast<std::uint8_t>(e);
                to.push_back(pass);
            } else {
                to.push_back({.name = pass.name,
                              .stage = pass.stage,
                              .resource = static_cast<std::uint8_t>(e),
                              .continues = true});
            }
        }
    }

    static void set_uniforms(const TextOfPass& text, UnusedNames& of_all, GlPass& pass) {
        UniformValues values;
        UnusedNames own(text.entry.uniforms);
        const auto give = [&](const std::string& name, const text::BasicType& type) {
            const auto in_all = of_all.take(name), here = own.take(name);
            if (here || in_all)
                values.add(name, type, here ? *here : *in_all);
            return here || in_all;
        };
        for (const text::PlainUniform& uniform : text.program.uniforms)
            give(uniform.name, uniform.type);
        for (const text::Block& block : text.program.blocks) {
            if (block.is_storage)
                continue;
            pass.uniform_blocks.push_back(block.name);
            for (const text::Block::Member& member : block.members) {
                // The program's interface has the block's name before a member's, whether it has an instance or not.
                const std::string whole = block.name + "." + member.name;
                if (!give(member.name, member.type) && !member.name.starts_with(block.name + "."))
                    give(whole, member.type);
                values.rename(member.name, whole);
            }
        }
        own.check(fmt::format("{} has no uniform of this name", text.file));
        for (const text::StageVariable& input : text.program.stage_inputs)
            if (const auto given = text.entry.inputs.find(input.name);
                given != text.entry.inputs.end() && !is_place(given->second))
                values.add(input.name, {.rows = input.components, .columns = input.cells / input.components},
                           given->second);
        pass.uniforms = [values](int frame) { return values.at(frame); };
    }

    const Document& document_;
    std::vector<TextOfPass> texts_;
    std::vector<std::vector<Use>> uses_; ///< of each pass
    std::vector<Record> records_;        ///< of each entry; none of images
};

} // namespace

BoundPasses bound_passes(const Document& document, const std::filesystem::path& shaders) {
    return Binder(document, shaders).bound();
}

} // namespace lockstep::check_file
