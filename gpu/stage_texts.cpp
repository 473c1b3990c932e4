#include "gpu/stage_texts.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "gpu/shader_words.hpp"
#include "gpu/spirv_module.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// A stage's own name of one of our outputs.
std::string their_name(const ShaderSource& stage, const std::string& ours) {
    return stage.bindings != nullptr ? stage.bindings->output(ours) : ours;
}

/// A stage's input or output, as declared.
struct Varying {
    std::string type, place;
    bool is_flat = false, located = false;
};

std::map<std::string, Varying> varyings(const ShaderSource& stage, std::string_view qualifier) {
    std::map<std::string, Varying> found;
    std::vector<std::string> statement;
    for (ShaderWords words(stage.text); words.next();) {
        if (words.token() != ";" && words.token() != "}") {
            statement.emplace_back(words.token());
            continue;
        }
        const auto has = [&](std::string_view word) {
            return std::find(statement.begin(), statement.end(), word) != statement.end();
        };
        if (words.token() == ";" && statement.size() > 2 && has(qualifier) && !has("(")) {
            const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
            found[statement.back()] = {statement[statement.size() - 2],
                                       fmt::format("{}:{}", stage.files[origin.file], origin.line), has("flat"),
                                       has("location")};
        }
        statement.clear();
    }
    return found;
}

/// Every block of the kind ("uniform", "buffer") that a stage declares: its name, and where.
std::vector<std::pair<std::string, std::string>> blocks(std::string_view kind, std::span<const ShaderSource> stages) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const ShaderSource& stage : stages) {
        std::string before, last;
        for (ShaderWords words(stage.text); words.next();) {
            if (words.token() == "{" && before == kind) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                found.emplace_back(last, fmt::format("{}:{}", stage.files[origin.file], origin.line));
            }
            before = std::exchange(last, std::string(words.token()));
        }
    }
    return found;
}

} // namespace

const ShaderSource* last_vertex_stage(std::span<const ShaderSource> stages) {
    for (const Stage stage : {Stage::geometry, Stage::vertex})
        for (const ShaderSource& source : stages)
            if (source.stage == stage)
                return &source;
    return nullptr;
}

std::string last_vertex_stage_file(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    return last != nullptr ? last->files.front() : "no vertex shader";
}

std::set<std::string> words_with(std::string_view prefix, std::string_view text) {
    std::set<std::string> found;
    for (ShaderWords words(text); words.next();)
        if (words.token().starts_with(prefix))
            found.emplace(words.token());
    return found;
}

bool goes_by_location(const ShaderSource& stage) {
    for (const std::string_view direction : {"in", "out"}) {
        const bool outside = stage.stage == (direction == "in" ? Stage::vertex : Stage::fragment);
        const std::map<std::string, Varying> all = varyings(stage, direction);
        if (!outside && std::any_of(all.begin(), all.end(), [](const auto& one) { return one.second.located; }))
            return true;
    }
    return false;
}

std::vector<std::string> spellings(std::string_view text, const std::string& output) {
    const std::string own = output.substr(output.rfind('.') + 1);
    std::vector<std::string> names{output};
    const auto add = [&](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    };
    std::string block, last, open; // the words before, and the block that is read
    bool is_open = false, has_member = false, is_closed = false;
    for (ShaderWords words(text); words.next();) {
        const std::string word(words.token());
        if (is_closed) { // an instance, or the end
            if (has_member && word != ";")
                add(word + "." + own);
            is_closed = has_member = false;
        } else if (is_open) {
            has_member = has_member || ((word == ";" || word == "[" || word == ",") && last == own);
            if (word == "}") {
                if (has_member) {
                    add(open + "." + own);
                    add(own);
                }
                is_open = false;
                is_closed = true;
            }
        } else if (word == "{" && block == "out") {
            is_open = true;
            open = last;
        }
        block = std::exchange(last, word);
    }
    return names;
}

bool is_same_output(std::string_view one, std::string_view other) {
    const auto own = [](std::string_view name) {
        if (name.ends_with("[0]"))
            name.remove_suffix(3);
        return name.substr(name.rfind('.') + 1);
    };
    const auto has_block = [](std::string_view name) { return name.find('.') != std::string_view::npos; };
    return one == other || (own(one) == own(other) && (has_block(one) || has_block(other)));
}

std::set<std::string> lengths_asked(const ShaderSource& stage) {
    if (stage.module != nullptr)
        return stage.module->asks_length ? std::set<std::string>{""} : std::set<std::string>{};
    std::set<std::string> asked, macros;
    std::string name, last;   // the words before
    std::size_t defining = 0; // the line that a #define ends with
    for (ShaderWords words(stage.text); words.next();) {
        const std::string_view word = words.token();
        if (name == "#" && last == "define") {
            macros.emplace(word);
            defining = words.line();
        }
        if (word == "\\" && words.line() == defining)
            ++defining;
        if (last == "." && word == "length")
            asked.insert(words.line() == defining ? "" : name);
        name = std::exchange(last, std::string(word));
    }
    if (std::ranges::any_of(asked, [&](const std::string& one) { return macros.contains(one); }))
        asked.insert("");
    return asked;
}

std::string missing_flat(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    const auto fragment =
        std::find_if(stages.begin(), stages.end(), [](const ShaderSource& s) { return s.stage == Stage::fragment; });
    if (last == nullptr || fragment == stages.end())
        return {};
    const std::map<std::string, Varying> written = varyings(*last, "out");
    for (const auto& [name, read] : varyings(*fragment, "in")) {
        const std::string theirs = their_name(*last, name);
        const auto out = written.find(theirs);
        if (out != written.end() && read.is_flat && !out->second.is_flat)
            return fmt::format(
                "shader {}: output {} is interpolated, but {} reads it `flat`; right is `flat out {} {};`",
                out->second.place, theirs, read.place, out->second.type, theirs);
    }
    return {};
}

void fail_storage(const std::string& place, const std::string& name) {
    throw Error(fmt::format("shader {}: nothing is given for storage buffer {}; storage buffers are bound in compute "
                            "shaders alone (docs/own_shader.md)",
                            place, name));
}

void check_storage(GLuint program, std::span<const ShaderSource> stages, std::span<const std::string_view> given) {
    if (stages.front().stage == Stage::compute)
        return;
    for (const auto& [name, place] : blocks("buffer", stages))
        if (std::find(given.begin(), given.end(), name) != given.end())
            continue;
        else if (gl::GetProgramInterfaceiv == nullptr)
            throw Error(fmt::format("shader {}: nothing is given for storage buffer {}, and this GL is too old to say "
                                    "whether it is used (4.3 or GL_ARB_program_interface_query says)",
                                    place, name));
        else if (gl::GetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, name.c_str()) != GL_INVALID_INDEX)
            fail_storage(place, name);
}

void check_geometry_inputs(std::span<const ShaderSource> stages) {
    const auto of = [&](Stage stage) {
        return std::find_if(stages.begin(), stages.end(), [&](const ShaderSource& s) { return s.stage == stage; });
    };
    const auto vertex = of(Stage::vertex), geometry = of(Stage::geometry);
    if (vertex == stages.end() || geometry == stages.end())
        return;
    const std::set<std::string> written = words_with("", vertex->text);
    std::string qualifier, type, name; // the words before
    bool located = false;
    for (ShaderWords words(geometry->text); words.next();) {
        const std::string word(words.token());
        if (word == "[" && qualifier == "in" && !located && !written.contains(name)) {
            const ShaderSource::Origin& origin = geometry->origins[words.line() - 1];
            throw Error(fmt::format("shader {}:{}: input {} is written by no stage before it ({}); an empty {} leaves "
                                    "the geometry stage out",
                                    geometry->files[origin.file], origin.line, name, vertex->files.front(),
                                    std::filesystem::path(geometry->files.front()).filename().string()));
        }
        located = word != ";" && (located || word == "location");
        qualifier = std::exchange(type, std::exchange(name, word));
    }
}

void check_fragment_inputs(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return;
    const std::set<std::string> written = words_with("", last->text);
    for (const ShaderSource& stage : stages) {
        if (stage.stage != Stage::fragment)
            continue;
        std::map<std::string, int> uses;
        for (ShaderWords words(stage.text); words.next();)
            ++uses[std::string(words.token())];
        std::string first, second, third; // the words before
        bool located = false;
        for (ShaderWords words(stage.text); words.next();) {
            if (words.token() == ";" && first == "in" && !located && uses[third] > 1 && !third.starts_with("gl_") &&
                !written.contains(their_name(*last, third))) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                throw Error(fmt::format("shader {}:{}: input {} is written by no stage before it ({})",
                                        stage.files[origin.file], origin.line, third, last->files.front()));
            }
            located = words.token() != ";" && (located || words.token() == "location");
            first = std::exchange(second, std::exchange(third, std::string(words.token())));
        }
    }
}

void check_fragment_output(GLuint program, std::span<const ShaderSource> stages) {
    for (const ShaderSource& stage : stages) {
        if (stage.stage != Stage::fragment)
            continue;
        for (const std::string& word : words_with("", stage.text))
            if (!word.starts_with("gl_") && gl::GetFragDataLocation(program, word.c_str()) == 0)
                return;
        throw Error(
            fmt::format("shader {}: no output at location 0 is written; that is what is drawn", stage.files.front()));
    }
}

} // namespace lockstep
