#include "crosscheck/files/shell_words.hpp"

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"

namespace lockstep {
namespace {

/// $'a\nb': control characters would do on a terminal what they say.
std::string dollar_quoted(std::string_view word) {
    std::string text = "$'";
    for (const char c : word) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\'' || c == '\\')
            text += std::string("\\") + c;
        else
            text += byte < 0x20 || byte >= 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    }
    return text + "'";
}

} // namespace

std::string shell_word(std::string_view word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=,.:/@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos)
        return std::string(word);
    if (!is_plain(word))
        return dollar_quoted(word);
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

std::string shell_path(const std::filesystem::path& path) {
    return shell_word(path.native().starts_with('-') ? "./" + path.string() : path.string());
}

} // namespace lockstep
