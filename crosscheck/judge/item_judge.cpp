#include "crosscheck/judge/item_judge.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <source_location>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/compare.hpp"
#include "reference/model/ulp.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

/// How many ULP a value lies outside of what is legal; 0 inside.
std::int64_t distance_to(const Interval& legal, Value value) {
    if (value.scalar != Scalar::float32) {
        const auto x = static_cast<double>(value.integer());
        return legal.any || (legal.low <= x && x <= legal.high)
                   ? 0
                   : static_cast<std::int64_t>(std::max(legal.low - x, x - legal.high));
    }
    if (legal.contains(value.real()))
        return 0;
    return std::min(ulp_distance(static_cast<float>(legal.low), value.real()),
                    ulp_distance(static_cast<float>(legal.high), value.real()));
}

/// A component of the item, its place among all of them, and the line of the twin that named it last.
struct NamedComponent {
    Component part;
    std::size_t place = 0;
    std::size_t named = 0; ///< how late in the step
    std::optional<std::source_location> where = {};
};

/// In the order in which the twin names them: what is named last follows from what is named before.
std::vector<NamedComponent> in_order_of_step(const JudgedPass& p, std::size_t item) {
    const Resource& about = p.gpu.about();
    const std::vector<RecordedRow> rows = p.pass.record(p.input(), item, p.profile);
    std::vector<NamedComponent> parts;
    for (const Component c : components(about)) {
        NamedComponent& part = parts.emplace_back(NamedComponent{c, parts.size()});
        const std::string_view output = p.pass.output(about, c.field);
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (rows[r].site->output == output || rows[r].site->label == output) {
                part.named = r;
                part.where = rows[r].where;
            }
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const NamedComponent& a, const NamedComponent& b) { return a.named < b.named; });
    return parts;
}

/// Where an item parts from an outcome: the first component outside, and how far.
struct Parting {
    std::size_t fitting = 0; ///< components before it
    std::int64_t ulps = 0;
};

Parting parting(const ItemOutcome& outcome, const View& gpu, std::size_t item,
                const std::vector<NamedComponent>& parts) {
    Parting at;
    for (const NamedComponent& c : parts) {
        at.ulps = distance_to(outcome.values[c.place], gpu.value(c.part.field, item, c.part.component));
        if (at.ulps != 0)
            return at;
        ++at.fitting;
    }
    return at;
}

std::string set_text(const Interval& legal, Scalar scalar) {
    if (scalar != Scalar::float32)
        return legal.low == legal.high ? fmt::format("{}", legal.low) : fmt::format("{} to {}", legal.low, legal.high);
    return legal.low == legal.high
               ? fmt::format("{}", static_cast<float>(legal.low))
               : fmt::format("{} to {}", static_cast<float>(legal.low), static_cast<float>(legal.high));
}

} // namespace

bool same_item(const View& a, const View& b, std::size_t item) {
    const std::vector<Component> parts = components(a.about());
    return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
        return same_bits(a.value(c.field, item, c.component), b.value(c.field, item, c.component));
    });
}

ItemVerdict judge_item(const JudgedPass& p, std::size_t item) {
    const auto outcomes = p.pass.outcomes(p.input(), item, p.profile, p.known, &p.gpu);
    ItemVerdict verdict{.index = item, .outcomes = outcomes.size()};
    std::vector<ItemOutcome> untold; // where no value of the GPU's was gone on from
    for (const ItemOutcome& outcome : outcomes) {
        if (!outcome.contains(p.gpu, item))
            continue;
        DifferenceClass kind = DifferenceClass::rounding;
        if (outcome.undefined != Undefined::none) {
            kind = DifferenceClass::undefined;
        } else if (outcomes.size() > 1) {
            if (untold.empty())
                untold = p.pass.outcomes(p.input(), item, p.profile, p.known, nullptr);
            const bool alike = std::any_of(untold.begin(), untold.end(), [&](const ItemOutcome& one) {
                return one.contains(p.gpu, item) && one.contains(p.reference, item);
            });
            kind = alike ? DifferenceClass::rounding : DifferenceClass::tie;
        }
        if (kind >= verdict.kind)
            continue;
        verdict.kind = kind;
        verdict.undefined = outcome.undefined;
        verdict.tie = std::nullopt;
        if (kind == DifferenceClass::tie && !outcome.open.empty())
            verdict.tie = Tie{{outcome.open.front().site, outcome.open.front().unit}, outcome.open.front().margin};
    }
    return verdict;
}

std::vector<ItemVerdict> judge_items(const JudgedPass& pass) {
    const std::vector<std::size_t> differing = differing_items(pass.reference, pass.gpu);
    std::vector<ItemVerdict> verdicts(differing.size());
    constexpr std::size_t block = 16;
    const auto blocks = static_cast<std::ptrdiff_t>((differing.size() + block - 1) / block);
    parallel_blocks(blocks, [&](std::ptrdiff_t b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        for (std::size_t i = first; i < std::min(first + block, differing.size()); ++i)
            verdicts[i] = judge_item(pass, differing[i]);
    });
    return verdicts;
}

WrongStep wrong_step_of_item(const JudgedPass& p, std::size_t item) {
    const std::vector<NamedComponent> parts = in_order_of_step(p, item);
    const auto outcomes = p.pass.outcomes(p.input(), item, p.profile, p.known, &p.gpu);
    const ItemOutcome* nearest = &outcomes.front();
    Parting best = parting(*nearest, p.gpu, item, parts);
    for (const ItemOutcome& outcome : outcomes) {
        const Parting at = parting(outcome, p.gpu, item, parts);
        if (std::pair(parts.size() - at.fitting, at.ulps) < std::pair(parts.size() - best.fitting, best.ulps)) {
            best = at;
            nearest = &outcome;
        }
    }
    const NamedComponent& wrong = parts[std::min(best.fitting, parts.size() - 1)];
    const Component c = wrong.part;
    const Field& field = p.gpu.fields()[c.field];
    WrongStep step;
    step.step = std::string(p.pass.name()) + ", " + field.name;
    step.operation = fmt::format("{} {} is legal", component_name(field, c.component),
                                 set_text(nearest->values[wrong.place], field.scalar));
    if (wrong.where)
        step.operation += fmt::format(" ({}:{})", std::filesystem::path(wrong.where->file_name()).filename().string(),
                                      wrong.where->line());
    const Value reference = p.reference.value(c.field, item, c.component),
                gpu = p.gpu.value(c.field, item, c.component);
    if (best.ulps != 0)
        step.margin = fmt::format("{} ULP outside", best.ulps);
    step.difference = {{p.pass.resource(), c.field}, item, c.component, reference, gpu, distance(reference, gpu)};
    return step;
}

} // namespace lockstep
