#include "crosscheck/report/debug_lines.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

std::vector<DebugLine> debug_lines(const ItemSteps& text, NumberFormat format) {
    if (!text.not_known.empty())
        throw Error(fmt::format("no lines of a shader's text: {}", text.not_known));
    std::vector<DebugLine> lines;
    for (TextLine& one : text_lines(text, format)) {
        // A variable that is set once more is the next turn of a loop.
        const bool goes_on =
            !lines.empty() && lines.back().where == one.where &&
            std::ranges::find(lines.back().values, one.name, &TextLine::name) == lines.back().values.end();
        if (!goes_on) {
            const auto source = text.lines.find(one.where);
            lines.push_back({one.where, source == text.lines.end() ? std::string() : source->second});
        }
        lines.back().values.push_back(std::move(one));
    }
    return lines;
}

std::string debug_line_text(const DebugLine& line) {
    std::string text = fmt::format("{}: {}\n", line.where, line.source);
    for (const TextLine& value : line.values)
        text += fmt::format("    {} {} {}\n", value.name, value.value == "yes" || value.value == "no" ? "is" : "=",
                            value.value);
    return text;
}

std::optional<std::string> line_of_break(std::string_view argument) {
    const std::size_t colon = argument.rfind(':');
    if (colon == std::string_view::npos || colon == 0 || colon + 1 == argument.size() ||
        argument.find_first_of(" <>=!") != std::string_view::npos ||
        !std::ranges::all_of(argument.substr(colon + 1), [](char c) { return c >= '0' && c <= '9'; }))
        return {};
    return std::string(argument);
}

} // namespace lockstep
