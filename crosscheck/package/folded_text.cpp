#include "crosscheck/package/folded_text.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

namespace lockstep {
namespace {

constexpr std::size_t key_columns = 10; // "repeat    "

bool holds_command(std::string_view line) {
    return line.starts_with("repeat ") || line.starts_with(std::string(key_columns, ' ') + "again: ");
}

/// Where `line` is broken to fit into `width`: the last space that does, else the first one after, `from` the text's
/// first column; npos: nowhere. Words in quotes stay whole.
std::size_t place_to_break(std::string_view line, std::size_t from, std::size_t width, bool quotes) {
    std::size_t found = std::string_view::npos;
    bool quoted = false;
    for (std::size_t i = from; i < line.size(); ++i) {
        if (i > width && found != std::string_view::npos)
            return found;
        if (quotes && line[i] == '\'')
            quoted = !quoted;
        if (line[i] == ' ' && !quoted)
            found = i;
    }
    return line.size() > width ? found : std::string_view::npos;
}

std::vector<std::string> folded_line(std::string line, std::size_t width) {
    const bool command = holds_command(line);
    const std::size_t room = command ? width - 2 : width;
    std::vector<std::string> lines;
    std::size_t from = std::max(key_columns, line.find_first_not_of(' '));
    while (line.size() > width) {
        const std::size_t place = place_to_break(line, from, room, command);
        if (place == std::string::npos)
            break;
        lines.push_back(line.substr(0, place) + (command ? " \\" : ""));
        line = std::string(key_columns + 2, ' ') + line.substr(place + 1);
        from = key_columns + 2;
    }
    lines.push_back(line);
    return lines;
}

} // namespace

std::string folded_text(const std::string& text, std::size_t width, std::size_t most) {
    std::vector<std::string> lines;
    std::size_t last_begin = 0;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (line.empty())
            continue; // Catch2 takes the indentation away from the line after
        last_begin = lines.size();
        for (std::string& part : folded_line(line, width))
            lines.push_back(std::move(part));
    }
    if (lines.size() > most) {
        const std::size_t kept = most - 1 - (lines.size() - last_begin);
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(kept),
                    lines.begin() + static_cast<std::ptrdiff_t>(last_begin));
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(kept), "  ...");
    }
    std::string folded;
    for (const std::string& line : lines)
        folded += line + "\n";
    return folded;
}

std::string line_of(const std::string& report, std::string_view name) {
    std::istringstream stream(report);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(name) && line.size() > key_columns && line[name.size()] == ' ')
            return line.substr(key_columns);
    return {};
}

std::string failure_first(const std::string& report) {
    constexpr std::array<std::string_view, 7> keys{"verdict",          "cause", "closest", "first", "note",
                                                   "          again:", "repeat"};
    std::array<std::string, keys.size()> first;
    std::string rest;
    std::string* block = &rest; // to which lines belong that are indented
    std::istringstream stream(report);
    for (std::string line; std::getline(stream, line);) {
        const auto key =
            std::find_if(keys.begin(), keys.end(), [&](std::string_view k) { return line.starts_with(k); });
        if (key != keys.end())
            block = &first[static_cast<std::size_t>(key - keys.begin())];
        else if (line.empty() || line.front() != ' ')
            block = &rest;
        *block += line + "\n";
    }
    std::string text;
    for (const std::string& one : first)
        text += one;
    return text + rest;
}

} // namespace lockstep
