#include "crosscheck/judge/item_likeness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "crosscheck/judge/legal_widths.hpp"
#include "crosscheck/judge/rounding_only.hpp"

namespace lockstep {
namespace {

auto values_of(const View& view, std::size_t item) {
    return [&view, item](const Component& c, std::size_t) { return view.value(c.field, item, c.component); };
}

auto values_of(std::span<const std::uint32_t> words, const View& like) {
    return [words, &like](const Component& c, std::size_t word) {
        return Value{like.fields()[c.field].scalar, words[word]};
    };
}

/// The most that the values of an item are apart, over its fields; `a` and `b`: of a component and its word. Integers
/// are the same or infinitely far apart.
double apart(const ItemLikeness& likeness, std::size_t item, const auto& a, const auto& b) {
    const JudgedPass& pass = likeness.pass();
    const std::span<const Component> parts = likeness.parts();
    const View& before = pass.before[pass.pass.resource()];
    std::array<std::array<float, 4>, 3> field{};
    double most = 0.0;
    for (std::size_t from = 0, to = 0; from < parts.size(); from = to) {
        std::size_t n = 0;
        for (to = from; to < parts.size() && parts[to].field == parts[from].field && n < 4; ++to) {
            const Value x = a(parts[to], to), y = b(parts[to], to);
            if (x.scalar != Scalar::float32) {
                if (!same_bits(x, y))
                    return HUGE_VAL;
                continue;
            }
            field[0][n] = x.real();
            field[1][n] = y.real();
            field[2][n++] = before.value(parts[to].field, item, parts[to].component).real();
        }
        most = std::max(most, ulps_apart(std::span(field[0].data(), n), std::span(field[1].data(), n),
                                         std::span(field[2].data(), n)));
    }
    return most;
}

} // namespace

bool alike(Value a, Value b) {
    return same_bits(a, b) || (a.scalar == Scalar::float32 && a.real() == 0.0F && b.real() == 0.0F);
}

bool ItemLikeness::are(const View& side, std::size_t item, std::span<const std::uint32_t> words) const {
    for (std::size_t w = 0; w < parts_.size(); ++w) {
        const Value has = side.value(parts_[w].field, item, parts_[w].component);
        if (!alike({has.scalar, words[w]}, has))
            return false;
    }
    return true;
}

bool ItemLikeness::are_gpus(std::size_t item, std::span<const std::uint32_t> words) const {
    return are(pass_.gpu, item, words);
}

bool ItemLikeness::may_be_gpus(std::size_t item, std::span<const std::uint32_t> words) const {
    constexpr double as_near = 4.0;     // what else leads there may err as well
    constexpr double far_ulps = 1024.0; // legal sets are not looked at beyond
    for (std::size_t w = 0; w < parts_.size(); ++w) {
        const Value gpu = pass_.gpu.value(parts_[w].field, item, parts_[w].component),
                    reference = pass_.reference.value(parts_[w].field, item, parts_[w].component),
                    made{gpu.scalar, words[w]};
        if (alike(made, gpu) || alike(made, reference))
            continue;
        if (gpu.scalar != Scalar::float32 ||
            !(std::abs(double{made.real()} - gpu.real()) <= as_near * std::abs(double{reference.real()} - gpu.real())))
            return ulps_from_gpus(item, words) <= far_ulps && are_legal(item, words);
    }
    return true;
}

bool ItemLikeness::are_legal(std::size_t item, std::span<const std::uint32_t> words) const {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = outcomes_.try_emplace(item);
    if (is_new)
        known->second = pass_.on_input().outcomes(pass_.input(), item, pass_.profile, pass_.known, nullptr);
    return std::ranges::any_of(known->second,
                               [&](const ItemOutcome& outcome) { return outcome.contains(words, pass_.gpu.about()); });
}

std::span<const Interval> ItemLikeness::sets_of(std::size_t item) const {
    const auto found = std::ranges::lower_bound(verdicts_, item, {}, &ItemVerdict::index);
    const bool diverges = found != verdicts_.end() && found->index == item && found->kind == DifferenceClass::divergent;
    return diverges ? found->sets : std::span<const Interval>();
}

bool ItemLikeness::are_within_leeway(std::size_t item, std::span<const std::uint32_t> words) const {
    constexpr double as_near = 2.0; // what is wrong may be wider than what is right
    const std::span<const Interval> sets = sets_of(item);
    for (std::size_t w = 0; w < parts_.size(); ++w) {
        const Value gpu = pass_.gpu.value(parts_[w].field, item, parts_[w].component), made{gpu.scalar, words[w]};
        if (alike(made, gpu))
            continue;
        if (sets.empty() || gpu.scalar != Scalar::float32)
            return false;
        const double right = std::abs(pass_.reference.value(parts_[w].field, item, parts_[w].component).real());
        const double larger = right > 0.0 ? std::max(1.0, std::abs(double{gpu.real()}) / right) : 1.0;
        if (!(std::abs(double{made.real()} - gpu.real()) <= as_near * larger * width_of(sets[w])))
            return false;
    }
    return true;
}

bool ItemLikeness::is_off_by_more(std::size_t item) const {
    constexpr double much = 16.0;
    const std::span<const Interval> sets = sets_of(item);
    if (sets.empty())
        return true;
    for (std::size_t w = 0; w < parts_.size(); ++w) {
        const Value gpu = pass_.gpu.value(parts_[w].field, item, parts_[w].component),
                    reference = pass_.reference.value(parts_[w].field, item, parts_[w].component);
        if (gpu.scalar != Scalar::float32
                ? !same_bits(gpu, reference)
                : !(std::abs(double{gpu.real()} - reference.real()) <= much * width_of(sets[w])))
            return true;
    }
    return false;
}

bool ItemLikeness::are_references(std::size_t item, std::span<const std::uint32_t> words) const {
    return are(pass_.reference, item, words);
}

double ItemLikeness::ulps_from_gpus(std::size_t item, std::span<const std::uint32_t> words) const {
    return apart(*this, item, values_of(words, pass_.gpu), values_of(pass_.gpu, item));
}

double ItemLikeness::ulps_between(std::size_t item, std::span<const std::uint32_t> a,
                                  std::span<const std::uint32_t> b) const {
    return apart(*this, item, values_of(a, pass_.gpu), values_of(b, pass_.gpu));
}

bool ItemLikeness::are_near_references(std::size_t item, std::span<const std::uint32_t> words) const {
    return apart(*this, item, values_of(words, pass_.reference), values_of(pass_.reference, item)) <= rewritten_ulps;
}

bool ItemLikeness::is_off_by_rounding(std::size_t item) const {
    return apart(*this, item, values_of(pass_.gpu, item), values_of(pass_.reference, item)) <= rewritten_ulps;
}

} // namespace lockstep
