#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lockstep {

/// Accepts the integers from min to max; anything else is told with both.
CLI::Validator integer(std::int64_t min, std::int64_t max);

/// A time that ends: seconds above 0.
CLI::Validator seconds();

/// Every option of every verb that takes a file or a folder refuses the empty name.
void refuse_empty_names(CLI::App& app);

/// For a verb of several modes: throws Error if an option was given that is not among `allowed`, which `mode` has.
/// "study: --csv does not go with --catalogue".
void check_options(const CLI::App& verb, std::string_view mode, std::span<const std::string_view> allowed);

/// An option whose value is one of a few names; anything else is told with all of them.
template <class Value> CLI::Option* add_choice(CLI::App& verb, const std::string& name, Value& value,
                                               std::vector<std::pair<std::string, Value>> choices,
                                               const std::string& description) {
    std::vector<std::string> names;
    for (const auto& [text, meaning] : choices)
        names.push_back(text);
    const auto choose = [&value, name, choices = std::move(choices), names](const std::string& chosen) {
        for (const auto& [text, meaning] : choices)
            if (text == chosen) {
                value = meaning;
                return;
            }
        throw CLI::ValidationError(name, fmt::format("'{}' is not one of {}", chosen, fmt::join(names, ", ")));
    };
    return verb.add_option_function<std::string>(name, choose, description)
        ->type_name(fmt::format("{}", fmt::join(names, "|")));
}

} // namespace lockstep
