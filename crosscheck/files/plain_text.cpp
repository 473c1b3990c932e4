#include "crosscheck/files/plain_text.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace lockstep {
namespace {

/// A code point and the bytes it takes; 0 bytes where they are no UTF-8 (RFC 3629).
struct Decoded {
    std::uint32_t code = 0;
    std::size_t bytes = 0;
};

Decoded decode(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t first = byte(0);
    if (first < 0x80)
        return {first, 1};
    const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < bytes)
        return {};
    std::uint32_t code = first & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80)
            return {};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    const bool longer_than_needed = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    if (longer_than_needed || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff))
        return {};
    return {code, bytes};
}

/// Characters that are seen, and stay where they are: none of Unicode's categories Cc, Zl and Zp, no mark of direction
/// (Bidi_Control), none without width that hides in a word.
bool is_shown(std::uint32_t code) {
    return !(code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x061c || (code >= 0x200b && code <= 0x200f) ||
             (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f) || code == 0xfeff ||
             (code >= 0xe0000 && code <= 0xe007f));
}

std::string escaped(Decoded at, char first) {
    if (at.bytes == 0)
        return fmt::format("\\x{:02x}", static_cast<unsigned char>(first));
    switch (at.code) {
    case '\n':
        return "\\n";
    case '\r':
        return "\\r";
    case '\t':
        return "\\t";
    default:
        return at.code < 0x80 ? fmt::format("\\x{:02x}", at.code) : fmt::format("\\u{:04x}", at.code);
    }
}

std::string plain(std::string_view text, bool keep_lines) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Decoded at = decode(text);
        const std::size_t bytes = at.bytes == 0 ? 1 : at.bytes;
        if (at.bytes > 0 && (is_shown(at.code) || (keep_lines && at.code == '\n')))
            out += text.substr(0, bytes);
        else
            out += escaped(at, text.front());
        text.remove_prefix(bytes);
    }
    return out;
}

} // namespace

std::string plain_line(std::string_view text) { return plain(text, false); }

std::string short_line(std::string_view text) {
    constexpr std::size_t most_first = 1000, most_last = 500;
    std::string line = plain_line(text);
    if (line.size() <= most_first + most_last)
        return line;
    const auto goes_on = [&](std::size_t at) { return (static_cast<unsigned char>(line[at]) & 0xc0U) == 0x80; };
    std::size_t first = most_first, last = line.size() - most_last;
    while (goes_on(first))
        --first;
    while (goes_on(last))
        ++last;
    return line.replace(first, last - first, " ... ");
}

std::string plain_text(std::string_view text) { return plain(text, true); }

bool is_plain(std::string_view text) { return plain_line(text) == text; }

std::string counted(std::size_t count, std::string_view one) {
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

} // namespace lockstep
