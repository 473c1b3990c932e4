#include "crosscheck/command/help_text.hpp"

#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lockstep {
namespace {

constexpr std::size_t text_column = 30;

/// Words in lines, the first of which has room for what stands before it; further ones begin at `indent`.
std::string wrapped(const std::string& text, std::size_t taken, std::size_t indent) {
    std::string lines;
    std::istringstream words(text);
    std::size_t column = taken;
    bool first = true;
    for (std::string word; words >> word; first = false) {
        if (!first && column + 1 + word.size() > help_columns) {
            lines += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!first) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
    }
    return lines + "\n";
}

/// A name and what it means, in two columns.
std::string entry(const std::string& name, const std::string& text) {
    std::string head = "  " + name;
    if (head.size() + 2 > text_column)
        head += "\n" + std::string(text_column, ' ');
    else
        head.resize(text_column, ' ');
    return head + wrapped(text, text_column, text_column);
}

std::string described(const Option& option) {
    if (option.required)
        return option.description + " (required)";
    return option.initial.empty() ? option.description
                                  : fmt::format("{} (default: {})", option.description, option.initial);
}

std::string usage(const Verb& verb, const std::string& called) {
    std::string line = fmt::format("Usage: {} [OPTIONS]", called);
    for (const Option& option : verb.options)
        if (is_argument(option))
            line += option.required ? " " + option.value : fmt::format(" [{}]", option.value);
    return line + (verb.verbs.empty() || verb.run ? "" : " VERB ...");
}

/// A verb that runs by itself or by a part has a line of either.
std::string usages(const Verb& verb, const std::string& called) {
    const std::string lines = wrapped(usage(verb, called), 0, 7);
    return verb.verbs.empty() || !verb.run ? lines : lines + fmt::format("{:7}{} VERB ...\n", "", called);
}

} // namespace

std::string help_text(const Verb& verb, const std::string& called) {
    std::string text = wrapped(verb.description, 0, 0) + "\n" + usages(verb, called);
    std::string arguments, options, verbs;
    for (const Option& option : all_options(verb)) {
        if (is_argument(option))
            arguments += entry(option.value, described(option));
        else
            options += entry(
                fmt::format("{}{}{}", fmt::join(names(option), ", "), option.value.empty() ? "" : " ", option.value),
                described(option));
    }
    if (!verb.version.empty())
        options += entry("--version", "print the version");
    for (const Verb& part : verb.verbs)
        verbs += entry(part.name, part.description);
    for (const auto& [head, entries] : {std::pair{"Arguments", arguments}, {"Options", options}, {"Verbs", verbs}})
        if (!entries.empty())
            text += fmt::format("\n{}:\n{}", head, entries);
    std::istringstream footer(verb.footer);
    if (!verb.footer.empty())
        text += "\n";
    for (std::string line; std::getline(footer, line);) {
        const std::size_t start = line.find_first_not_of(' ');
        text += std::string(start, ' ') + wrapped(line, start, start + 2);
    }
    return text;
}

} // namespace lockstep
