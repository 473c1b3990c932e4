#include "crosscheck/commands/option_values.hpp"

#include <charconv>

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

} // namespace lockstep
