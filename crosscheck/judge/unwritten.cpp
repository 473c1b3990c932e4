#include "crosscheck/judge/unwritten.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "gpu/canary.hpp"

namespace lockstep {
namespace {

std::set<std::uint8_t> unwritten_fields(const View& again, std::size_t item) {
    std::set<std::uint8_t> fields;
    for (const Component& c : components(again.about()))
        if (again.value(c.field, item, c.component).bits == canary_word)
            fields.insert(c.field);
    return fields;
}

} // namespace

Unwritten unwritten_in(const View& again, std::span<const ItemVerdict> verdicts) {
    Unwritten found;
    std::set<std::set<std::uint8_t>> kinds;
    for (const ItemVerdict& verdict : verdicts)
        if (verdict.kind == DifferenceClass::divergent) {
            ++found.cause.divergent;
            kinds.insert(unwritten_fields(again, verdict.index));
        }
    found.none = std::ranges::all_of(kinds, [](const std::set<std::uint8_t>& fields) { return fields.empty(); });
    if (found.none || kinds.size() > 1)
        return found;
    Cause cause{.mistakes = {}, .meaning = "what lay there before stayed", .explained = found.cause.divergent};
    const std::set<std::uint8_t>& fields = *kinds.begin();
    if (fields.size() == again.fields().size())
        cause.mistakes = {"items_not_written"};
    else
        for (const std::uint8_t f : fields)
            cause.mistakes.push_back(fmt::format("{}_not_written", again.fields()[f].name));
    found.cause.best = {std::move(cause)};
    return found;
}

} // namespace lockstep
