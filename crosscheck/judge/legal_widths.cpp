#include "crosscheck/judge/legal_widths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "reference/model/state_view.hpp"

namespace lockstep {
namespace {

constexpr int steps = 8; ///< an octave
constexpr int nothing = std::numeric_limits<int>::min(), everything = std::numeric_limits<int>::max();

int step_of(double width) {
    if (width == 0.0)
        return nothing;
    return std::isfinite(width) ? static_cast<int>(std::ceil(std::log2(width) * steps)) : everything;
}
double bound_of(int step) {
    if (step == nothing)
        return 0.0;
    return step == everything ? HUGE_VAL : std::exp2(static_cast<double>(step) / steps);
}

} // namespace

double width_of(const Interval& set) {
    const double width = set.any ? HUGE_VAL : set.high - set.low;
    return std::isnan(width) ? 0.0 : width;
}

LegalWidths::LegalWidths(const Schema& schema, std::uint8_t resource) {
    for (const Component& c : components(schema.resources[resource])) {
        const FieldId field{resource, c.field};
        parts_.push_back({field, c.component, schema[field].scalar == Scalar::float32});
    }
}

LegalWidths::LegalWidths(const Schema& schema, std::uint8_t resource, Counts counts,
                         const std::optional<Widest>& widest)
    : LegalWidths(schema, resource) {
    counts_ = std::move(counts);
    widest_ = widest;
}

void LegalWidths::add(int frame, std::size_t index, std::span<const Interval> sets) {
    if (sets.size() != parts_.size())
        throw std::logic_error("an item has as many legal sets as components");
    std::optional<LegalFloats> widest;
    for (std::size_t c = 0; c < sets.size(); ++c)
        if (parts_[c].is_float && (!widest || width_of(sets[c]) > widest->width()))
            widest = LegalFloats{parts_[c].field, parts_[c].component, sets[c]};
    if (!widest)
        return;
    ++counts_[step_of(widest->width())];
    if (!widest_ || widest->width() > widest_->floats.width())
        widest_ = {frame, index, *widest};
}

void LegalWidths::join(const LegalWidths& next) {
    for (const auto& [step, count] : next.counts_)
        counts_[step] += count;
    if (next.widest_ && (!widest_ || next.widest_->floats.width() > widest_->floats.width()))
        widest_ = next.widest_;
}

double LegalWidths::half() const {
    std::uint64_t items = 0, below = 0;
    for (const auto& [step, count] : counts_)
        items += count;
    for (const auto& [step, count] : counts_) {
        below += count;
        if (2 * below >= items)
            return std::min(bound_of(step), widest_->floats.width());
    }
    return 0.0;
}

} // namespace lockstep
