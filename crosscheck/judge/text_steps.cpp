#include "crosscheck/judge/text_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

/// What many values are by chance.
bool is_common(float x) { return x == 0.0F || std::abs(x) == 1.0F; }

bool is_decision(const StepRow& row) { return row.reference.text == "yes" || row.reference.text == "no"; }

/// Whether these are the digits of a word, signed or not.
bool is_integer(const std::string& digits, std::uint32_t word) {
    return digits == fmt::format("{}", word) || digits == fmt::format("{}", static_cast<std::int32_t>(word));
}

char component_of(const std::string& name) {
    return name.size() > 2 && name[name.size() - 2] == '.' ? name.back() : '\0';
}

/// Whether a row is called as a variable is.
bool has_name(const StepRow& row, const TextStep& step) {
    const std::string variable = step.name.substr(0, step.name.find_last_of(".["));
    return !variable.empty() && row.label.find(variable) != std::string::npos;
}

/// How much speaks for a number being a row's; 0: it is not.
int likeness_of_numbers(const StepRow& row, const TextStep& step) {
    if (is_decision(row) || step.compares)
        return 0;
    const int named = (step.name.empty() ? 0 : 1) + (has_name(row, step) ? 2 : 0);
    if (!row.reference.number)
        return !step.is_real && is_integer(row.reference.text, step.bits) ? 1 + named : 0;
    if (!step.is_real) // twins count in floats where texts have integers
        return *row.reference.number == static_cast<float>(static_cast<std::int32_t>(step.bits)) ? 1 + named : 0;
    if (!same_bits(*row.reference.number, std::bit_cast<float>(step.bits)))
        return 0;
    return (is_common(*row.reference.number) ? 1 : 4) + named +
           (component_of(row.label) == component_of(step.name) ? 1 : 0);
}

/// The same of decisions. Integers are compared by loops, and by guards, which twins have not.
int likeness_of_decisions(const StepRow& row, const TextStep& step) {
    const bool is_one = is_decision(row) && step.compares && step.is_real;
    return !is_one ? 0 : row.reference.text == cell_of(step).text ? 3 : 1;
}

using Likeness = int(const StepRow& row, const TextStep& step);

/// Of each row the step that is its own, where both go on in one order.
std::vector<std::optional<std::size_t>> in_order(const std::vector<StepRow>& rows, const std::vector<TextStep>& steps,
                                                 Likeness& likeness) {
    enum class From : std::uint8_t { row, step, both };
    const std::size_t width = steps.size() + 1;
    std::vector<int> best(width, 0), above(width, 0);
    std::vector<From> from(rows.size() * steps.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::swap(best, above);
        best[0] = 0;
        for (std::size_t s = 0; s < steps.size(); ++s) {
            const int like = likeness(rows[r], steps[s]);
            From& way = from[r * steps.size() + s];
            way = above[s + 1] >= best[s] ? From::row : From::step;
            best[s + 1] = std::max(above[s + 1], best[s]);
            if (like > 0 && above[s] + like > best[s + 1]) {
                best[s + 1] = above[s] + like;
                way = From::both;
            }
        }
    }
    std::vector<std::optional<std::size_t>> of(rows.size());
    for (std::size_t r = rows.size(), s = steps.size(); r > 0 && s > 0;) {
        const From way = from[(r - 1) * steps.size() + s - 1];
        if (way == From::both)
            of[r - 1] = s - 1;
        r -= way == From::step ? 0 : 1;
        s -= way == From::row ? 0 : 1;
    }
    return of;
}

/// Decisions that compare integers alone: the last such comparison between what the rows around it are.
void put_integers(const std::vector<StepRow>& rows, const std::vector<TextStep>& steps,
                  std::vector<std::optional<std::size_t>>& of) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (of[r] || !is_decision(rows[r]))
            continue;
        std::size_t first = 0, last = steps.size();
        for (std::size_t k = 0; k < r; ++k)
            first = of[k] ? *of[k] + 1 : first;
        for (std::size_t k = rows.size(); k-- > r + 1;)
            last = of[k] ? *of[k] : last;
        for (std::size_t s = first; s < last; ++s)
            if (steps[s].compares && !steps[s].is_real)
                of[r] = s;
    }
}

} // namespace

Cell cell_of(const TextStep& step) {
    if (step.compares || step.is_boolean)
        return {{}, step.bits != 0 ? "yes" : "no"};
    if (step.is_real)
        return {std::bit_cast<float>(step.bits), {}};
    return {{},
            step.is_signed ? fmt::format("{}", static_cast<std::int32_t>(step.bits)) : fmt::format("{}", step.bits)};
}

void align(std::vector<StepRow>& rows, const ItemSteps& text) {
    if (!text.not_known.empty())
        return;
    constexpr std::size_t most_steps = 20'000;
    std::vector<TextStep> steps = text.steps;
    steps.resize(std::min(steps.size(), most_steps));
    std::vector<std::optional<std::size_t>> of = in_order(rows, steps, likeness_of_numbers);
    const std::vector<std::optional<std::size_t>> decisions = in_order(rows, steps, likeness_of_decisions);
    // Texts that go another way come by a value elsewhere.
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto is_its = [&](const TextStep& one) { return likeness_of_numbers(rows[r], one) > 0; };
        if (decisions[r])
            of[r] = decisions[r];
        else if (const auto other = std::ranges::find_if(steps, is_its); !of[r] && other != steps.end())
            of[r] = static_cast<std::size_t>(other - steps.begin());
    }
    put_integers(rows, steps, of);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        StepRow& row = rows[r];
        const TextStep* own = of[r] ? &steps[*of[r]] : nullptr;
        if (own != nullptr)
            row.where = own->name.empty() ? own->where : own->where + " " + own->name;
        if (!row.gpu.empty() || row.reference.empty())
            continue;
        row.gpu = own != nullptr ? cell_of(*own) : Cell{{}, "not in the text"};
    }
}

} // namespace lockstep
