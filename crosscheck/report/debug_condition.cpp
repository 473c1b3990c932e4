#include "crosscheck/report/debug_condition.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct Relation {
    std::string_view text;
    bool (*holds)(double, double);
};

// Longer ones first: the first that a text has is its own.
constexpr std::array<Relation, 6> relations{{
    {"<=", [](double a, double b) { return a <= b; }},
    {">=", [](double a, double b) { return a >= b; }},
    {"==", [](double a, double b) { return a == b; }},
    {"!=", [](double a, double b) { return a != b; }},
    {"<", [](double a, double b) { return a < b; }},
    {">", [](double a, double b) { return a > b; }},
}};

} // namespace

std::string trimmed(std::string_view text) {
    constexpr std::string_view white_space = " \t\r";
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos)
        return "";
    return std::string(text.substr(first, text.find_last_not_of(white_space) + 1 - first));
}

DebugCondition parse_condition(const std::string& text) {
    for (const Relation& one : relations) {
        const std::size_t at = text.find(one.text);
        if (at == std::string::npos)
            continue;
        DebugCondition condition{trimmed(text.substr(0, at)), std::string(one.text), 0.0};
        const std::string number = trimmed(text.substr(at + one.text.size()));
        const char* const end = number.data() + number.size();
        const auto [rest, status] = std::from_chars(number.data(), end, condition.number);
        if (condition.label.empty() || number.empty() || status != std::errc{} || rest != end ||
            std::isnan(condition.number))
            break;
        return condition;
    }
    throw Error(fmt::format("break: '{}' is not NAME < NUMBER; <=, >, >=, ==, != go as well", text));
}

std::string condition_text(const DebugCondition& condition) {
    return fmt::format("{} {} {}", condition.label, condition.comparison, condition.number);
}

std::optional<float> value_of(std::string_view label, const std::vector<StepRow>& rows) {
    // The last of a name: what the step leaves.
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
        if (row->label == label)
            return row->gpu.number ? row->gpu.number : row->reference.number;
    return {};
}

bool holds(const DebugCondition& condition, float value) {
    const auto* const found = std::find_if(relations.begin(), relations.end(),
                                           [&](const Relation& one) { return one.text == condition.comparison; });
    return found->holds(static_cast<double>(value), condition.number);
}

} // namespace lockstep
