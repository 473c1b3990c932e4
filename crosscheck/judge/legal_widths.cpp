#include "crosscheck/judge/legal_widths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double LegalFloats::width() const {
    const double width = set.any ? HUGE_VAL : set.high - set.low;
    return std::isnan(width) ? 0.0 : width;
}

void LegalWidths::add(const Place& place, const LegalFloats& floats) {
    ++counts_[step_of(floats.width())];
    if (!widest_ || floats.width() > widest_->floats.width())
        widest_ = {place, floats};
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
