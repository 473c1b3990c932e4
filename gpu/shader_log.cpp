#include "gpu/shader_log.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace lockstep {
namespace {

/// Calls `visit` with each line until it returns true.
template <class Visit> void find_line(const std::string& log, const Visit& visit) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\0'))
            line.pop_back();
        if (!line.empty() && visit(line))
            return;
    }
}

/// A driver may quote a line of any length.
std::string shortened(std::string_view text) {
    constexpr std::size_t longest = 1000;
    return text.size() <= longest ? std::string(text) : std::string(text.substr(0, longest - 3)) + "...";
}

bool speaks_of_error(std::string_view line) {
    constexpr std::string_view word = "error";
    return std::search(line.begin(), line.end(), word.begin(), word.end(),
                       [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; }) != line.end();
}

/// What is left of a line that is taken apart from the front.
class Rest {
  public:
    explicit Rest(std::string_view text) : text_(text) {}
    [[nodiscard]] std::string_view text() const { return text_; }

    bool take(std::string_view word) {
        if (!text_.starts_with(word))
            return false;
        text_.remove_prefix(word.size());
        return true;
    }

    std::optional<std::size_t> number() {
        std::size_t value = 0;
        const auto [end, status] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (status != std::errc{})
            return {};
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return value;
    }

  private:
    std::string_view text_;
};

/// How a compiler begins the line of an error: gives its line number and leaves the message; nothing for another line.
using Form = std::optional<std::size_t> (*)(Rest&);

/// `0:12(3): error: MESSAGE`, `0:12(3): preprocessor error: MESSAGE`
std::optional<std::size_t> mesa(Rest& rest) {
    if (!rest.number() || !rest.take(":"))
        return {};
    const auto line = rest.number();
    if (!line || !rest.take("(") || !rest.number() || !rest.take("): "))
        return {};
    rest.take("preprocessor ");
    return rest.take("error: ") ? line : std::nullopt;
}

/// `0(12) : error C1234: MESSAGE`
std::optional<std::size_t> nvidia(Rest& rest) {
    if (!rest.number() || !rest.take("("))
        return {};
    const auto line = rest.number();
    return line && rest.take(") : error ") ? line : std::nullopt;
}

/// `ERROR: 0:12: MESSAGE`
std::optional<std::size_t> others(Rest& rest) {
    if (!rest.take("ERROR: ") || !rest.number() || !rest.take(":"))
        return {};
    const auto line = rest.number();
    return line && rest.take(": ") ? line : std::nullopt;
}

} // namespace

std::string first_link_error(const std::string& log) {
    std::string first;
    std::string found;
    find_line(log, [&](const std::string& line) {
        if (first.empty())
            first = line;
        if (speaks_of_error(line))
            found = line;
        return !found.empty();
    });
    if (first.empty())
        return "the driver gives no reason";
    return shortened(found.empty() ? first : found);
}

std::string first_compile_error(const std::string& log, const ShaderSource& source) {
    std::string result;
    find_line(log, [&](const std::string& line) {
        for (const Form form : {mesa, nvidia, others}) {
            Rest rest(line);
            const std::optional<std::size_t> number = form(rest);
            if (!number || *number < 1 || *number > source.origins.size())
                continue;
            const ShaderSource::Origin& origin = source.origins[*number - 1];
            result = fmt::format("{}:{}: {}", source.files[origin.file], origin.line, shortened(rest.text()));
        }
        return !result.empty();
    });
    return result.empty() ? fmt::format("{}: {}", source.files.front(), first_link_error(log)) : result;
}

} // namespace lockstep
