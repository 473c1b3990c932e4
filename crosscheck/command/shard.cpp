#include "crosscheck/command/shard.hpp"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_parts = 1'000'000;

std::optional<std::size_t> number(std::string_view text) {
    std::size_t value = 0;
    const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && rest == text.data() + text.size() && !text.empty() && value <= most_parts
               ? std::optional(value)
               : std::nullopt;
}

/// A pair of the environment's variables: the part, from 0, and the number of parts.
std::optional<Shard> told_by(const char* index_name, const char* count_name) {
    const char* const index = std::getenv(index_name);
    const char* const count = std::getenv(count_name);
    if (index == nullptr && count == nullptr)
        return {};
    const auto part = number(index == nullptr ? "" : index), of = number(count == nullptr ? "" : count);
    if (!part || !of || *part >= *of) {
        const auto told = [](const char* name, const char* value) {
            return value == nullptr ? fmt::format("{} is not set", name) : fmt::format("{} is '{}'", name, value);
        };
        throw Error(
            fmt::format("the environment: {} and {}; right are both, a part counted from 0 and the number of parts",
                        told(index_name, index), told(count_name, count)));
    }
    return Shard{*part + 1, *of, fmt::format("{}={} of {}={}", index_name, *part, count_name, *of)};
}

} // namespace

Option shard_option(Shard& target) {
    const auto keep = [&target](std::span<const std::string> values) {
        const std::string_view text = values.front();
        const std::size_t slash = std::min(text.find('/'), text.size());
        const auto part = number(text.substr(0, slash)), of = number(text.substr(std::min(slash + 1, text.size())));
        if (!part || !of || *part < 1 || *part > *of)
            return fmt::format("'{}' is no part; right is K/N with K from 1 to N, 2/8 say", text);
        target = {*part, *of, fmt::format("--shard {}", text)};
        return std::string();
    };
    return {"--shard", "K/N", "check part K of N (1/N to N/N)", keep};
}

Shard shard_of_environment() {
    if (const auto shard = told_by("TEST_SHARD_INDEX", "TEST_TOTAL_SHARDS"))
        return *shard;
    return told_by("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE").value_or(Shard{});
}

} // namespace lockstep
