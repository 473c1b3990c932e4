#include "crosscheck/report/colour.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace lockstep {
namespace {

/// The escape sequence before a word; empty: it has no colour.
std::string_view color_of(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> all{
        {{"AGREE", "\033[32m"},
         {"FAILED", "\033[31m"},
         {"LEGAL", "\033[33m"},
         {"UNDEFINED", "\033[31m"},
         {"DIVERGENT", "\033[31m"},
         {"DIFFER", "\033[31m"},
         {"NONDETERMINISTIC", "\033[31m"}}};
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == word; });
    return found == all.end() ? std::string_view() : found->second;
}

bool is_wanted() {
    const char* none = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return isatty(STDOUT_FILENO) == 1 && (none == nullptr || *none == '\0') && terminal != nullptr &&
           std::string_view(terminal) != "dumb";
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

} // namespace

std::string colored(std::string text) {
    if (!is_wanted())
        return text;
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_letter(text[end]))
            ++end;
        const std::string_view word(text.data() + i, end - i);
        const std::string_view color = color_of(word);
        result.append(color).append(word).append(color.empty() ? "" : "\033[0m");
        for (i = end; i < text.size() && !is_letter(text[i]); ++i)
            result += text[i];
    }
    return result;
}

} // namespace lockstep
