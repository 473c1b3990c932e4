#include "crosscheck/command/option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

using Texts = std::span<const std::string>;

/// Nothing unless `text` is a number and no more than that.
template <class Number> std::optional<Number> number(const std::string& text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, value);
    return status == std::errc{} && rest == end ? std::optional(value) : std::nullopt;
}

/// Appends to `integers`; returns what is wrong with the first text that is none.
template <class Integer> std::string read(Texts texts, IntegerRange range, std::vector<Integer>& integers) {
    for (const std::string& text : texts) {
        const std::optional<std::int64_t> value = number<std::int64_t>(text);
        if (!value || *value < range.min || *value > range.max)
            return fmt::format("'{}' is not an integer from {} to {}", text, range.min, range.max);
        if (std::find(integers.begin(), integers.end(), static_cast<Integer>(*value)) != integers.end())
            return fmt::format("'{}' is given more than once", text);
        integers.push_back(static_cast<Integer>(*value));
    }
    return {};
}

/// The option with what its target holds before the command line is read.
template <class Value> Option starting_at(Option option, const Value& value) {
    option.initial = fmt::format("{}", value);
    return option;
}

template <class Integer, class Target>
Option one_integer(std::string name, std::string value, IntegerRange range, Target& target, std::string description) {
    const auto keep = [range, &target](Texts texts) {
        std::vector<Integer> integers;
        const std::string problem = read(texts, range, integers);
        if (problem.empty())
            target = integers.front();
        return problem;
    };
    return {std::move(name), std::move(value), std::move(description), keep};
}

template <class Integer> Option some_integers(std::string name, std::string value, IntegerRange range,
                                              std::vector<Integer>& target, std::string description) {
    const auto keep = [range, &target](Texts texts) {
        target.clear();
        return read(texts, range, target);
    };
    return starting_at(Option{std::move(name), std::move(value), std::move(description), keep, GivenValues::list},
                       fmt::format("{}", fmt::join(target, ",")));
}

template <class Target> Option one_text(std::string name, std::string value, Target& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        target = texts.front();
        return std::string();
    };
    return {std::move(name), std::move(value), std::move(description), keep};
}

} // namespace

Option flag(std::string name, bool& target, std::string description) {
    const auto keep = [&target](Texts) {
        target = true;
        return std::string();
    };
    return {std::move(name), {}, std::move(description), keep};
}

Option text_option(std::string name, std::string value, std::string& target, std::string description) {
    return starting_at(one_text(std::move(name), std::move(value), target, std::move(description)), target);
}

Option text_option(std::string name, std::string value, std::optional<std::string>& target, std::string description) {
    return one_text(std::move(name), std::move(value), target, std::move(description));
}

Option texts_option(std::string name, std::string value, std::vector<std::string>& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        target.assign(texts.begin(), texts.end());
        return std::string();
    };
    return {std::move(name), std::move(value), std::move(description), keep, GivenValues::repeated};
}

Option settings_option(std::string name, std::string value, std::vector<std::string>& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        std::vector<std::string> names;
        for (const std::string& text : texts) {
            names.push_back(text.substr(0, text.find('=')));
            if (std::find(names.begin(), names.end() - 1, names.back()) != names.end() - 1)
                return fmt::format("{} is given more than once", names.back());
        }
        target.assign(texts.begin(), texts.end());
        return std::string();
    };
    return {std::move(name), std::move(value), std::move(description), keep, GivenValues::repeated};
}

std::pair<std::string, std::string> setting_parts(const std::string& text) {
    const std::size_t sign = text.find('=');
    return {text.substr(0, sign), sign == std::string::npos ? std::string() : text.substr(sign + 1)};
}

std::pair<std::string, std::string> macro_of(std::string_view option, const std::string& text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::pair<std::string, std::string> macro = setting_parts(text);
    const std::string& name = macro.first;
    if (name.empty() || is_digit(name.front()) ||
        !std::ranges::all_of(name, [&](char c) { return is_letter(c) || is_digit(c); }))
        throw Error(fmt::format("{} {}: '{}' is no name of a macro; expected NAME=TEXT", option, plain_line(text),
                                plain_line(name)));
    if (macro.second.find_first_of("\r\n") != std::string::npos)
        throw Error(fmt::format("{} {}: expected a text of one line", option, plain_line(text)));
    return macro;
}

Option path_option(std::string name, std::string value, std::filesystem::path& target, std::string description) {
    const auto keep = [&target, folder = value == "DIR"](Texts texts) {
        target = texts.front();
        return target.empty() ? fmt::format("'' names no {}", folder ? "folder" : "file") : "";
    };
    return starting_at(Option{std::move(name), std::move(value), std::move(description), keep}, target.string());
}

Option integer_option(std::string name, std::string value, IntegerRange range, int& target, std::string description) {
    return starting_at(one_integer<int>(std::move(name), std::move(value), range, target, std::move(description)),
                       target);
}

Option integer_option(std::string name, std::string value, IntegerRange range, std::size_t& target,
                      std::string description) {
    return starting_at(
        one_integer<std::size_t>(std::move(name), std::move(value), range, target, std::move(description)), target);
}

Option integer_option(std::string name, std::string value, IntegerRange range, std::optional<std::size_t>& target,
                      std::string description) {
    return one_integer<std::size_t>(std::move(name), std::move(value), range, target, std::move(description));
}

std::string FrameRange::text() const { return is_part ? fmt::format("{}..{}", first, end - 1) : std::to_string(end); }

Option frames_option(std::string name, FrameRange& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        const std::string& text = texts.front();
        const std::size_t dots = text.find("..");
        const bool is_part = dots != std::string::npos;
        const std::optional<int> first = is_part ? number<int>(text.substr(0, dots)) : std::optional(0),
                                 last = number<int>(is_part ? text.substr(dots + 2) : text);
        const int end = last.value_or(0) + (is_part ? 1 : 0);
        if (!first || !last || *first < 0 || *last < 0 || *last > most_frames || *first >= end)
            return is_part ? fmt::format("'{}' is no range of frames; right is A..B, both from 0 to {}, A at most B",
                                         text, most_frames)
                           : fmt::format("'{}' is not an integer from 1 to {}", text, most_frames);
        target = {*first, end, is_part};
        return std::string();
    };
    return {std::move(name), "N", std::move(description), keep};
}

Option integers_option(std::string name, std::string value, IntegerRange range, std::vector<int>& target,
                       std::string description) {
    return some_integers(std::move(name), std::move(value), range, target, std::move(description));
}

Option integers_option(std::string name, std::string value, IntegerRange range, std::vector<std::size_t>& target,
                       std::string description) {
    return some_integers(std::move(name), std::move(value), range, target, std::move(description));
}

Option seconds_option(std::string name, double& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        const std::optional<double> value = number<double>(texts.front());
        if (!value || !std::isfinite(*value) || *value <= 0.0)
            return fmt::format("'{}' is not a number of seconds above 0", texts.front());
        target = *value;
        return std::string();
    };
    return starting_at(Option{std::move(name), "S", std::move(description), keep}, target);
}

Option share_option(std::string name, double& target, std::string description) {
    const auto keep = [&target](Texts texts) {
        std::string text = texts.front();
        const bool percent = text.ends_with('%');
        if (percent)
            text.pop_back();
        const std::optional<double> value = number<double>(text);
        const double most = percent ? 100.0 : 1.0;
        if (!value || !(*value >= 0.0 && *value <= most))
            return fmt::format("'{}' is not a share, as 95% or 0.95", texts.front());
        target = *value / most;
        return std::string();
    };
    return {std::move(name), "SHARE", std::move(description), keep};
}

Option named_option(std::string name, std::vector<std::string> choices, std::function<void(std::size_t)> choose,
                    std::string description) {
    std::string value = fmt::format("{}", fmt::join(choices, "|"));
    const auto keep = [choices = std::move(choices), choose = std::move(choose)](Texts texts) {
        const auto chosen = std::find(choices.begin(), choices.end(), texts.front());
        if (chosen == choices.end())
            return fmt::format("'{}' is not one of {}{}", texts.front(), fmt::join(choices, ", "),
                               did_you_mean(texts.front(), choices));
        choose(static_cast<std::size_t>(chosen - choices.begin()));
        return std::string();
    };
    return {std::move(name), std::move(value), std::move(description), keep};
}

Option word_option(std::string name, std::vector<std::string> words, std::string& target, std::string description) {
    const auto choose = [&target, words](std::size_t place) { target = words[place]; };
    return starting_at(named_option(std::move(name), words, choose, std::move(description)), target);
}

Option word_option(std::string name, std::vector<std::string> words, std::optional<std::string>& target,
                   std::string description) {
    const auto choose = [&target, words](std::size_t place) { target = words[place]; };
    return named_option(std::move(name), words, choose, std::move(description));
}

Option required(Option option) {
    option.required = true;
    option.initial.clear();
    return option;
}

Option otherwise(Option option, std::string initial) {
    option.initial = std::move(initial);
    return option;
}

} // namespace lockstep
