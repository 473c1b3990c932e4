#include "gpu/shader_log.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

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

/// A line of a compiler's log about a line of the text.
struct About {
    bool is_warning = false;
    std::size_t line = 0;
};

/// How a compiler begins such a line: leaves the message; nothing for another line.
using Form = std::optional<About> (*)(Rest&);

/// `0:12(3): error: MESSAGE`, `0:12(3): preprocessor error: MESSAGE`, `0:12(3): warning: MESSAGE`
std::optional<About> mesa(Rest& rest) {
    if (!rest.number() || !rest.take(":"))
        return {};
    const auto line = rest.number();
    if (!line || !rest.take("(") || !rest.number() || !rest.take("): "))
        return {};
    rest.take("preprocessor ");
    const bool is_warning = rest.take("warning: ");
    return is_warning || rest.take("error: ") ? std::optional(About{is_warning, *line}) : std::nullopt;
}

/// `0(12) : error C1234: MESSAGE`, `0(12) : warning C7050: MESSAGE`
std::optional<About> nvidia(Rest& rest) {
    if (!rest.number() || !rest.take("("))
        return {};
    const auto line = rest.number();
    if (!line || !rest.take(") : "))
        return {};
    const bool is_warning = rest.take("warning ");
    return is_warning || rest.take("error ") ? std::optional(About{is_warning, *line}) : std::nullopt;
}

/// `ERROR: 0:12: MESSAGE`, `WARNING: 0:12: MESSAGE`
std::optional<About> others(Rest& rest) {
    const bool is_warning = rest.take("WARNING: ");
    if ((!is_warning && !rest.take("ERROR: ")) || !rest.number() || !rest.take(":"))
        return {};
    const auto line = rest.number();
    return line && rest.take(": ") ? std::optional(About{is_warning, *line}) : std::nullopt;
}

/// `FILE:LINE` of a line of a stage's text; nothing where it has no such line. The text's end is its last line's.
std::optional<std::string> place(const ShaderSource& source, std::size_t line) {
    if (line < 1 || line > source.origins.size() + 1 || source.origins.empty())
        return {};
    const ShaderSource::Origin& origin = source.origins[std::min(line, source.origins.size()) - 1];
    return fmt::format("{}:{}", source.files[origin.file], origin.line);
}

std::optional<ShaderWarning> warning_in(const std::string& line, const ShaderSource& source) {
    for (const Form form : {mesa, nvidia, others}) {
        Rest rest(line);
        if (const std::optional<About> about = form(rest))
            return about->is_warning
                       ? std::optional(ShaderWarning{place(source, about->line).value_or(source.files.front()),
                                                     shortened(rest.text())})
                       : std::nullopt;
    }
    Rest rest(line); // of the whole program
    if (rest.take("warning: ") || rest.take("WARNING: "))
        return ShaderWarning{source.files.front(), shortened(rest.text())};
    return {};
}

} // namespace

std::string first_link_error(const std::string& log) {
    std::string first;
    std::string found;
    find_line(log, [&](const std::string& line) {
        if (first.empty())
            first = line;
        if (found.ends_with(':')) { // the next line says it
            found += fmt::format(" {}", std::string_view(line).substr(line.find_first_not_of(" \t")));
            return true;
        }
        if (speaks_of_error(line))
            found = line;
        return !found.empty() && !found.ends_with(':');
    });
    if (first.empty())
        return "the driver gives no reason";
    return shortened(found.empty() ? first : found);
}

std::vector<ShaderWarning> compile_warnings(const std::string& log, const ShaderSource& source) {
    std::vector<ShaderWarning> found;
    find_line(log, [&](const std::string& line) {
        if (std::optional<ShaderWarning> warning = warning_in(line, source))
            found.push_back(std::move(*warning));
        return false;
    });
    return found;
}

std::vector<ShaderWarning> link_warnings(const std::string& log, std::span<const ShaderSource> stages) {
    constexpr std::array<std::pair<std::string_view, Stage>, 4> paragraphs{{{"Vertex info", Stage::vertex},
                                                                            {"Geometry info", Stage::geometry},
                                                                            {"Fragment info", Stage::fragment},
                                                                            {"Compute info", Stage::compute}}};
    std::vector<ShaderWarning> found;
    const ShaderSource* of = &stages.front();
    find_line(log, [&](const std::string& line) {
        for (const auto& [heading, stage] : paragraphs)
            for (const ShaderSource& source : stages)
                if (line.starts_with(heading) && source.stage == stage)
                    of = &source;
        if (std::optional<ShaderWarning> warning = warning_in(line, *of))
            found.push_back(std::move(*warning));
        return false;
    });
    return found;
}

std::string first_compile_error(const std::string& log, const ShaderSource& source) {
    std::string result;
    find_line(log, [&](const std::string& line) {
        for (const Form form : {mesa, nvidia, others}) {
            Rest rest(line);
            const std::optional<About> about = form(rest);
            if (!about || about->is_warning)
                continue;
            if (const std::optional<std::string> where = place(source, about->line))
                result = fmt::format("{}: {}", *where, shortened(rest.text()));
        }
        return !result.empty();
    });
    return result.empty() ? fmt::format("{}: {}", source.files.front(), first_link_error(log)) : result;
}

} // namespace lockstep
