#include "crosscheck/package/function_signature.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "gpu/preprocessor.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep::function_twin {
namespace {

struct Word {
    std::string text;
    std::size_t line = 1, begin = 0; ///< of the text
};

std::vector<Word> words_of(const std::string& text) {
    std::vector<Word> all;
    for (ShaderWords words(text); words.next();)
        all.push_back(
            {std::string(words.token()), words.line(), static_cast<std::size_t>(words.token().data() - text.data())});
    return all;
}

const std::set<std::string, std::less<>> qualifiers{"in", "const", "highp", "mediump", "lowp", "precise"};

/// Of the words between a definition's brackets.
std::vector<Parameter> parameters_of(const std::vector<Word>& words, std::size_t first, std::size_t last) {
    std::vector<Parameter> found;
    std::vector<std::string> one;
    const auto end_one = [&] {
        if (!one.empty() && !(one.size() == 1 && one.front() == "void"))
            found.push_back({one.front(), one.size() > 1 ? fmt::format("{}", fmt::join(one.begin() + 1, one.end(), ""))
                                                         : std::string()});
        one.clear();
    };
    for (std::size_t w = first; w < last; ++w)
        if (words[w].text == ",")
            end_one();
        else if (!qualifiers.contains(words[w].text))
            one.push_back(words[w].text);
    end_one();
    return found;
}

/// The definitions of functions, outside of any braces: TYPE NAME ( ... ) {
std::vector<std::pair<std::string, Signature>> definitions_in(const std::string& text) {
    const std::vector<Word> words = words_of(text);
    std::vector<std::pair<std::string, Signature>> found;
    int depth = 0;
    for (std::size_t w = 0; w < words.size(); ++w) {
        if (words[w].text == "{")
            ++depth;
        if (words[w].text == "}")
            --depth;
        if (depth != 0 || words[w].text != "(" || w < 2)
            continue;
        const auto close = std::find_if(words.begin() + static_cast<std::ptrdiff_t>(w), words.end(),
                                        [](const Word& word) { return word.text == ")"; });
        const auto end = static_cast<std::size_t>(close - words.begin());
        if (end + 1 < words.size() && words[end + 1].text == "{")
            found.push_back(
                {words[w - 1].text, {words[w - 2].text, parameters_of(words, w + 1, end), words[w - 1].line}});
    }
    return found;
}

/// "vec3,float"
std::string types_of(const Signature& signature) {
    std::vector<std::string> types;
    for (const Parameter& parameter : signature.parameters)
        types.push_back(parameter.type);
    return fmt::format("{}", fmt::join(types, ","));
}

std::string without_spaces(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
    return text;
}

/// "'mix3(vec3)', 'mix3(vec3,float)'"
std::string all_shown(const std::string& name, const std::vector<Signature>& all) {
    std::vector<std::string> shown;
    for (const Signature& one : all)
        shown.push_back(fmt::format("'{}({})'", name, types_of(one)));
    return fmt::format("{}", fmt::join(shown, ", "));
}

bool is(const std::vector<Word>& words, std::size_t i, std::string_view what) {
    return i < words.size() && words[i].text == what;
}

/// The first word behind the bracket that closes the one at `open`; nothing where none does.
std::optional<std::size_t> behind_bracket(const std::vector<Word>& words, std::size_t open) {
    const std::string_view closing = is(words, open, "(") ? ")" : "}";
    int depth = 0;
    for (std::size_t i = open; i < words.size(); ++i) {
        if (words[i].text == words[open].text)
            ++depth;
        else if (words[i].text == closing && --depth == 0)
            return i + 1;
    }
    return {};
}

/// The first word behind what begins at i and only a stage of its own kind has: its main, a shared variable, what lays
/// out its inputs. Nothing where nothing of the kind begins.
std::optional<std::size_t> behind_stage_part(const std::vector<Word>& words, std::size_t i) {
    if (is(words, i, "void") && is(words, i + 1, "main") && is(words, i + 2, "(")) {
        const std::optional<std::size_t> body = behind_bracket(words, i + 2);
        return body && is(words, *body, "{") ? behind_bracket(words, *body) : std::nullopt;
    }
    if (is(words, i, "layout") && is(words, i + 1, "(")) {
        const std::optional<std::size_t> in = behind_bracket(words, i + 1);
        return in && is(words, *in, "in") && is(words, *in + 1, ";") ? std::optional(*in + 2) : std::nullopt;
    }
    const bool is_layout = i > 0 && (is(words, i - 1, "(") || is(words, i - 1, ",")); // of a block
    if (is(words, i, "shared") && !is_layout)
        for (std::size_t end = i; end < words.size(); ++end)
            if (is(words, end, ";"))
                return end + 1;
    return {};
}

} // namespace

std::string text_of_file(const GlslFunction& function) {
    std::string text = read_shader_file(function.file);
    const std::vector<Word> words = words_of(text);
    for (std::size_t i = 0; i < words.size(); ++i)
        if (const std::optional<std::size_t> end = behind_stage_part(words, i)) {
            const auto first = text.begin() + static_cast<std::ptrdiff_t>(words[i].begin),
                       last = text.begin() + static_cast<std::ptrdiff_t>(words[*end - 1].begin + 1); // a bracket or ;
            std::replace_if(
                first, last, [](char c) { return c != '\n'; }, ' ');
            i = *end - 1;
        }
    return text;
}

std::string type_of(const Column& column) {
    if (column.is_bool)
        return "bool";
    const std::size_t scalar = static_cast<std::size_t>(column.scalar);
    if (column.components == 1)
        return std::array{"float", "int", "uint"}[scalar];
    return fmt::format("{}vec{}", std::array{"", "i", "u"}[scalar], column.components);
}

std::optional<Column> column_of(const std::string& type) {
    if (type == type_of({Scalar::int32, 1, true}))
        return Column{Scalar::int32, 1, true};
    for (const Scalar scalar : {Scalar::float32, Scalar::int32, Scalar::uint32})
        for (int components = 1; components <= 4; ++components)
            if (type == type_of({scalar, components}))
                return Column{scalar, components};
    return {};
}

Signature signature_of(const GlslFunction& function) {
    const ShaderSource whole = whole_text(function);
    const std::string own = std::filesystem::path(function.file).filename().string();
    std::vector<Signature> found;
    std::vector<std::string> names;
    for (auto& [name, signature] : definitions_in(preprocessed(whole.text).value_or(whole.text))) {
        const ShaderSource::Origin& origin = whole.origins[std::min(signature.line, whole.origins.size()) - 1];
        if (std::filesystem::path(whole.files[origin.file]).filename() != own)
            continue; // of a file that it includes
        signature.line = static_cast<std::size_t>(origin.line);
        names.push_back(name == main_of_the_file ? "main" : name);
        if (names.back() == function.name)
            found.push_back(signature);
    }
    if (found.empty())
        throw Error(fmt::format("shader {}: defines no function {}{}{}", plain_line(function.file),
                                plain_line(function.name),
                                names.empty() ? "" : fmt::format("; it has {}", fmt::join(names, ", ")),
                                did_you_mean(function.name, names)));
    if (!function.parameters.empty()) {
        const auto is_other = [&](const Signature& one) {
            return types_of(one) != without_spaces(function.parameters);
        };
        const std::vector<Signature> all = std::exchange(found, {});
        std::ranges::remove_copy_if(all, std::back_inserter(found), is_other);
        if (found.empty())
            throw Error(fmt::format("shader {}: defines no {}({}); it has {}", plain_line(function.file), function.name,
                                    plain_line(function.parameters), all_shown(function.name, all)));
    }
    if (found.size() > 1)
        throw Error(fmt::format("shader {}:{}: {} is defined more than once; expected one of {}",
                                plain_line(function.file), found[1].line, function.name,
                                all_shown(function.name, found)));
    return found.front();
}

std::string shown(const std::string& name, const Signature& signature) {
    std::vector<std::string> types;
    for (const Parameter& parameter : signature.parameters)
        types.push_back(parameter.type);
    return fmt::format("{} {}({})", signature.result, name, fmt::join(types, ", "));
}

std::vector<DeclaredUniform> uniforms_of(const GlslFunction& function) {
    const ShaderSource whole = whole_text(function);
    const std::vector<Word> words = words_of(preprocessed(whole.text).value_or(whole.text));
    std::vector<DeclaredUniform> found;
    for (std::size_t w = 0; w + 2 < words.size(); ++w) {
        if (words[w].text != "uniform")
            continue;
        std::size_t at = w + 1;
        while (at + 1 < words.size() && qualifiers.contains(words[at].text))
            ++at;
        const std::string type = words[at].text;
        const auto size_at = [&](std::size_t bracket) {
            std::size_t size = 0;
            const std::string& word = words[std::min(bracket + 1, words.size() - 1)].text;
            std::from_chars(word.data(), word.data() + word.size(), size);
            return size;
        };
        const bool is_array = words[at + 1].text == "["; // uniform float[3] u_Weights
        const std::size_t elements = is_array ? size_at(at + 1) : 0;
        while (is_array && at + 1 < words.size() && words[at].text != "]")
            ++at;
        int depth = 0;
        bool named = false; // of a declarator, what comes after its name is its array and its value
        for (++at; at < words.size() && words[at].text != ";"; ++at) {
            const std::string& word = words[at].text;
            if (word == "{" && !named)
                break; // a block: its members go by it
            if (named && word == "[" && depth == 0 && words[at - 1].text == found.back().name) {
                found.back().is_array = true;
                found.back().elements = size_at(at);
            }
            depth += word == "(" || word == "[" ? 1 : word == ")" || word == "]" ? -1 : 0;
            if (word == "," && depth == 0)
                named = false;
            else if (!named) {
                found.push_back({type, word, is_array, elements});
                named = true;
            }
        }
    }
    return found;
}

void fail(const GlslFunction& function, const Signature& signature, const std::string& what) {
    throw Error(fmt::format("shader {}:{}: {}: {}", plain_line(function.file), signature.line,
                            shown(function.name, signature), what));
}

} // namespace lockstep::function_twin
