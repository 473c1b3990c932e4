#include "crosscheck/cli/option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "reference/model/error.hpp"

namespace lockstep {

CLI::Validator integer(std::int64_t min, std::int64_t max) {
    const auto problem = [min, max](std::string& text) -> std::string {
        std::int64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, status] = std::from_chars(text.data(), end, value);
        if (status == std::errc{} && rest == end && value >= min && value <= max)
            return {};
        return fmt::format("'{}' is not an integer from {} to {}", text, min, max);
    };
    return {problem, ""};
}

CLI::Validator seconds() {
    const auto problem = [](std::string& text) -> std::string {
        double value = 0.0;
        const char* const end = text.data() + text.size();
        const auto [rest, status] = std::from_chars(text.data(), end, value);
        const bool number = status == std::errc{} && rest == end && std::isfinite(value);
        return number && value > 0.0 ? "" : fmt::format("'{}' is not a number of seconds above 0", text);
    };
    return {problem, ""};
}

void refuse_empty_names(CLI::App& app) {
    for (CLI::Option* option : app.get_options())
        if (const std::string type = option->get_type_name(); type == "FILE" || type == "DIR" || type == "SCENE")
            option->check(CLI::Validator(
                [type](std::string& name) {
                    return name.empty() ? fmt::format("'' names no {}", type == "DIR" ? "folder" : "file") : "";
                },
                ""));
    for (CLI::App* verb : app.get_subcommands({}))
        refuse_empty_names(*verb);
}

void check_options(const CLI::App& verb, std::string_view mode, std::span<const std::string_view> allowed) {
    for (const CLI::Option* option : verb.get_options())
        if (option->count() > 0 && std::find(allowed.begin(), allowed.end(), option->get_name()) == allowed.end())
            throw Error(fmt::format("{}: {} does not go with {}", verb.get_name(), option->get_name(), mode));
}

} // namespace lockstep
