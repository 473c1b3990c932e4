#include "crosscheck/check_file/new_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/check_file/bound_passes.hpp"
#include "crosscheck/check_file/shader_text.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "gpu/old_glsl.hpp"
#include "reference/model/error.hpp"

namespace lockstep::check_file {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr std::uint32_t guessed_groups = 4, guessed_side = 64;

/// A name in small letters, without the words by which two copies are told apart: "boids" of BoidsIn and u_boidsOut.
std::string stem_of(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string_view prefix : {"u_", "in_", "out_", "src_", "dst_", "old_", "new_", "prev_", "next_"})
        if (name.starts_with(prefix) && name.size() > prefix.size())
            name.erase(0, prefix.size());
    for (const std::string_view suffix :
         {"before", "after", "previous", "prev", "next", "input", "output", "source", "src",   "destination", "dst",
          "dest",   "read",  "write",    "old",  "new",  "in",    "out",    "buffer", "block", "ssbo",        "_"})
        if (name.ends_with(suffix) && name.size() > suffix.size())
            name.erase(name.size() - suffix.size());
    return name;
}

json guessed_start(Scalar scalar, int seed) {
    return scalar == Scalar::float32 ? json{{"random", {-1, 1}}, {"seed", seed}}
                                     : json{{"random", {0, 100}}, {"seed", seed}};
}

json guessed_uniform(const text::BasicType& type, std::vector<std::string>& todo, const std::string& place) {
    todo.push_back(place + ": a guess");
    const json one = type.is_boolean ? json(true) : type.is_real ? json(0.5) : json(1);
    const std::uint32_t numbers = type.rows * type.columns;
    json value = one;
    if (numbers > 1)
        value = json(std::vector<json>(numbers, one));
    if (type.columns > 1 && type.columns == type.rows) // the identity
        for (std::uint32_t k = 0; k < numbers; ++k)
            value[k] = k % (type.rows + 1) == 0 ? 1 : 0;
    return type.elements == 0 ? value : json(std::vector<json>(type.elements, value));
}

/// On one line where that is short, else a line for each element.
std::string laid_out(const json& value, std::size_t indent) {
    constexpr std::size_t longest = 110, step = 2;
    if (!value.is_structured() || value.empty())
        return value.dump();
    std::vector<std::string> parts;
    for (const auto& [key, element] : value.items())
        parts.push_back((value.is_object() ? json(key).dump() + ": " : "") + laid_out(element, indent + step));
    const bool is_object = value.is_object();
    const std::string line =
        fmt::format("{}{}{}", is_object ? "{ " : "[", fmt::join(parts, ", "), is_object ? " }" : "]");
    if (indent > 0 && indent + line.size() < longest && line.find('\n') == std::string::npos)
        return line;
    const std::string outer(indent, ' '), inner(indent + step, ' ');
    return fmt::format("{}\n{}{}\n{}{}", is_object ? "{" : "[", inner, fmt::join(parts, ",\n" + inner), outer,
                       is_object ? "}" : "]");
}

class Writer {
  public:
    json write(std::span<const fs::path> shaders) {
        json made;
        made["todo"] = json::array();
        made["state"] = json::object();
        made["passes"] = json::array();
        for (const fs::path& shader : shaders)
            made["passes"].push_back(pass(shader));
        for (const auto& [name, entry] : state_)
            made["state"][name] = entry;
        for (const std::string& one : todo_)
            made["todo"].push_back(one);
        return made;
    }

  private:
    json pass(const fs::path& shader) {
        const Stage stage = shader.extension() == ".frag" ? Stage::fragment : Stage::compute;
        if (stage == Stage::compute && shader.extension() != ".comp")
            throw Error(fmt::format("new check: {} is no stage of a check file; expected NAME.comp, or NAME.frag for a "
                                    "full-screen pass",
                                    plain_line(shader.string())));
        const fs::path folder = shader.has_parent_path() ? shader.parent_path() : fs::path(".");
        if (folder_ && *folder_ != folder)
            throw Error(fmt::format("new check: {} lies in another folder than the first shader; expected one folder",
                                    plain_line(shader.string())));
        folder_ = folder;
        if (!fs::is_regular_file(shader))
            throw Error(fmt::format("new check: there is no file {}", plain_line(shader.string())));
        const ShaderText text = shader_text(shader_folders(folder, system_name), shader.stem().string(), stage);
        json made{{"shader", shader.filename().string()}};
        json bind = json::object(), uniforms = json::object();
        std::set<std::string> writers; // entries that a block or image of this pass writes
        for (std::size_t b = 0; b < text.program.blocks.size(); ++b)
            if (text.program.blocks[b].is_storage)
                bind[text.program.blocks[b].name] = buffer(text, b, writers);
        for (std::size_t i = 0; i < text.program.images.size(); ++i)
            bind[text.program.images[i].name] = image(text.program.images[i], text.accesses.images[i], writers);
        for (const text::StageVariable& output : text.program.stage_outputs)
            if (!output.builtin && stage == Stage::fragment)
                bind[old_name(output.name)] = image({old_name(output.name), true, {}, output.is_real},
                                                    {.is_written = true}, writers, output.cells);
        const auto add_uniform = [&](const std::string& name, const text::BasicType& type) {
            uniforms[name] =
                guessed_uniform(type, todo_, fmt::format("uniform {} of {}", name, shader.filename().string()));
        };
        for (const text::PlainUniform& uniform : text.program.uniforms)
            add_uniform(uniform.name, uniform.type);
        for (const text::Block& block : text.program.blocks)
            for (const text::Block::Member& member : block.members)
                if (!block.is_storage)
                    add_uniform(member.name, member.type);
        for (const text::StageVariable& input : text.program.stage_inputs)
            if (!input.builtin && input.is_read) {
                const std::string place = fmt::format("input {} of {}", input.name, shader.filename().string());
                if (input.cells == 2)
                    todo_.push_back(place + ": a guess, its place in the image, 0 to 1");
                made["inputs"][input.name] = input.cells == 2
                                                 ? json("uv")
                                                 : guessed_uniform({.is_real = input.is_real,
                                                                    .is_boolean = input.is_boolean,
                                                                    .rows = input.components,
                                                                    .columns = input.cells / input.components},
                                                                   todo_, place);
            }
        if (!bind.empty())
            made["bind"] = bind;
        if (!uniforms.empty())
            made["uniforms"] = uniforms;
        return made;
    }

    /// The name of the entry that the block or image is: that of another of this stem, where this is the other of its
    /// two copies, or both are in place.
    std::string entry_named(const std::string& name, const text::Access& access, const std::set<std::string>& writers,
                            const std::string& kind) {
        std::string stem = stem_of(name);
        const bool is_free = !access.is_written || !writers.contains(stem);
        const auto known = kinds_.find(stem);
        if (is_free && (known == kinds_.end() || known->second == kind)) {
            kinds_[stem] = kind;
            return stem;
        }
        std::string own = name;
        kinds_[own] = kind;
        return own;
    }

    std::string buffer(const ShaderText& text, std::size_t b, std::set<std::string>& writers) {
        const text::Block& block = text.program.blocks[b];
        const Record record = record_of(block, text.file);
        if (record.fields.empty())
            throw Error(
                fmt::format("new check: block {} has members beside an array without a size; expected the array alone",
                            record.declared));
        std::string kind = fmt::format("{} words", record.words);
        for (const Field& field : record.fields)
            kind += fmt::format(" {}{}", glsl_type(field), field.at.value_or(0));
        const std::string name = entry_named(block.name, text.accesses.blocks[b], writers, kind);
        if (text.accesses.blocks[b].is_written)
            writers.insert(name);
        if (state_.contains(name))
            return name;
        json entry{{"count", record.count != 0 ? record.count : text.program.invocations() * guessed_groups}};
        if (record.count == 0)
            todo_.push_back(fmt::format("count of {}: a guess, {} groups of {}", name, guessed_groups, text.file));
        json start = json::object();
        for (const Field& field : record.fields)
            start[field.name] = guessed_start(field.scalar, ++seed_);
        entry["start"] = record.fields.size() == 1 ? start.front() : start;
        todo_.push_back(fmt::format("start of {}: a guess", name));
        state_.emplace_back(name, entry);
        return name;
    }

    /// `components`: that are written.
    std::string image(const text::ImageUniform& image, const text::Access& access, std::set<std::string>& writers,
                      std::uint32_t components = 4) {
        const std::uint32_t axes = image.shape.axes();
        std::string format = format_of(image).name;
        if (components < 3 && format.starts_with("rgba"))
            format.replace(0, 4, components == 1 ? "r" : "rg");
        if (axes < 2 || axes > 3 || image.shape.is_arrayed || format.empty())
            throw Error(fmt::format("new check: image {} is of a kind that a check file does not have; expected two or "
                                    "three dimensions, and formats as r32f or rgba8",
                                    image.name));
        const std::string name = entry_named(image.name, access, writers, fmt::format("{} axes", axes));
        if (access.is_written)
            writers.insert(name);
        if (state_.contains(name)) {
            if (image.is_storage && image.shape.format != spv::ImageFormatUnknown)
                state_.at(name)["format"] = format;
            return name;
        }
        todo_.push_back(fmt::format("size and start of {}: guesses", name));
        if (image.shape.format == spv::ImageFormatUnknown)
            todo_.push_back(fmt::format("format of {}: a guess", name));
        json entry{{"size", axes == 2 ? json{guessed_side, guessed_side} : json{guessed_side, guessed_side, 8}},
                   {"format", format}};
        entry["start"] = image.is_real && !format.ends_with('8') ? json{{"random", {0, 1}}, {"seed", ++seed_}}
                                                                 : guessed_start(Scalar::uint32, ++seed_);
        state_.emplace_back(name, entry);
        return name;
    }

    /// In the order in which shaders name them.
    struct Entries : std::vector<std::pair<std::string, json>> {
        [[nodiscard]] auto found(const std::string& name) {
            return std::ranges::find(*this, name, &std::pair<std::string, json>::first);
        }
        [[nodiscard]] bool contains(const std::string& name) { return found(name) != end(); }
        [[nodiscard]] json& at(const std::string& name) { return found(name)->second; }
    };
    Entries state_;
    std::map<std::string, std::string> kinds_; ///< of each entry, what it is made of
    std::vector<std::string> todo_;
    std::optional<fs::path> folder_;
    int seed_ = 0;
};

} // namespace

std::string new_file(std::span<const fs::path> shaders) { return laid_out(Writer().write(shaders), 0) + "\n"; }

} // namespace lockstep::check_file
