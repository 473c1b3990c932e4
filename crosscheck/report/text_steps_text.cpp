#include "crosscheck/report/text_steps_text.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {
namespace {

std::string value_of(const TextStep& step, NumberFormat format) {
    const Cell cell = cell_of(step);
    return cell.number ? number_text(*cell.number, format) : cell.text;
}

/// The name without its component.
std::string variable_of(const std::string& name) { return name.substr(0, name.find_last_of(".[")); }

/// Of what a loop comes by again and again the first few times and the last.
std::vector<TextLine> without_turns(std::vector<TextLine> lines) {
    constexpr int first_turns = 3;
    std::map<std::pair<std::string, std::string>, int> all, seen;
    const auto key = [](const TextLine& line) {
        const bool is_decision = line.value == "yes" || line.value == "no";
        return std::pair(line.where, is_decision ? std::string() : line.name);
    };
    for (const TextLine& line : lines)
        ++all[key(line)];
    std::erase_if(lines, [&](const TextLine& line) {
        const int turn = ++seen[key(line)];
        return turn > first_turns && turn < all[key(line)];
    });
    return lines;
}

/// "it ends in what the GPU made", or the first value that is another.
std::string end_text(const JudgedPass& pass, std::size_t item, const ItemSteps& text, NumberFormat format) {
    const Resource& about = pass.gpu.about();
    const std::vector<Component> parts = components(about);
    for (std::size_t k = 0; k < parts.size() && k < text.made.size(); ++k) {
        const Field& field = about.fields[parts[k].field];
        const Value gpu = pass.gpu.value(parts[k].field, item, parts[k].component);
        if (gpu.bits == text.made[k])
            continue;
        return fmt::format("it ends in {} {}, the GPU has {}", component_name(field, parts[k].component),
                           value_text({field.scalar, text.made[k]}, format), value_text(gpu, format));
    }
    return "it ends in the GPU's bits";
}

} // namespace

std::vector<TextLine> text_lines(const ItemSteps& text, NumberFormat format) {
    const std::vector<TextStep>& steps = text.steps;
    std::vector<TextLine> lines;
    for (std::size_t k = 0; k < steps.size();) {
        const TextStep& first = steps[k];
        if (first.name.empty()) {
            ++k;
            continue;
        }
        std::size_t end = k + 1;
        const auto goes_on = [&](const TextStep& next) {
            return !first.compares && !next.compares && next.where == first.where && next.name != first.name &&
                   first.name.find('.') != std::string::npos && variable_of(next.name) == variable_of(first.name) &&
                   next.name > steps[end - 1].name;
        };
        std::string value = value_of(first, format);
        while (end < steps.size() && goes_on(steps[end]))
            value += ", " + value_of(steps[end++], format);
        const bool is_whole = end - k > 1;
        lines.push_back({first.where, is_whole ? variable_of(first.name) : first.name,
                         is_whole ? "(" + value + ")" : std::move(value)});
        k = end;
    }
    return lines;
}

std::string text_steps_text(const JudgedPass& pass, std::size_t item, const ItemSteps& text, NumberFormat format) {
    if (!text.not_known.empty())
        return fmt::format("text      not run for it: {}\n", text.not_known);
    constexpr std::size_t most_lines = 200;
    const std::vector<TextLine> lines = without_turns(text_lines(text, format));
    std::string all =
        fmt::format("text      {}, run by lockstep: {}\n\n", text.file, end_text(pass, item, text, format));
    std::size_t place = 0, name = 0;
    for (const TextLine& line : lines) {
        place = std::max(place, line.where.size());
        name = std::max(name, std::min(line.name.size(), narrowest_label));
    }
    for (const TextLine& line : lines) {
        if (&line == lines.data() + most_lines) {
            all += fmt::format("  ({} more)\n", lines.size() - most_lines);
            break;
        }
        all += fmt::format("  {:<{}} {:<{}} {}\n", line.where, place, line.name, name, line.value);
    }
    return all;
}

} // namespace lockstep
