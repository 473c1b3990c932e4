#include "crosscheck/judge/append_judge.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

#include "crosscheck/judge/compare.hpp"

namespace lockstep {
namespace {

using Words = std::vector<std::uint32_t>;

/// Each item of a range, and how often it is there.
std::map<Words, std::size_t> counted(const View& state, ItemRange range) {
    std::map<Words, std::size_t> counts;
    for (std::size_t i = range.first; i < range.first + range.count; ++i)
        ++counts[item_words(state, i)];
    return counts;
}

bool has(ItemRange range, std::size_t item) { return item >= range.first && item - range.first < range.count; }

} // namespace

bool same_but_for_order(const ItemPass& pass, const PassInput& in, const View& a, const View& b) {
    const std::vector<std::size_t> differing = differing_items(a, b);
    if (differing.empty())
        return true;
    const std::optional<ItemRange> range = pass.appended(in);
    return range && std::all_of(differing.begin(), differing.end(), [&](std::size_t i) { return has(*range, i); }) &&
           counted(a, *range) == counted(b, *range);
}

std::vector<ItemVerdict> judge_appended(const JudgedPass& pass) {
    static constexpr TieKind order{"order of appending", ""};
    const ItemRange range = pass.pass.appended(pass.input()).value_or(ItemRange{});
    std::map<Words, std::size_t> left = counted(pass.reference, range);
    // Those at their place first: of two that are alike, the other is one too many.
    const std::vector<std::size_t> differing = differing_items(pass.reference, pass.gpu);
    std::size_t next = 0;
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        while (next < differing.size() && differing[next] < i)
            ++next;
        if (next == differing.size() || differing[next] != i)
            --left[item_words(pass.reference, i)];
    }
    std::vector<ItemVerdict> verdicts;
    for (const std::size_t i : differing) {
        ItemVerdict verdict{.index = i, .outcomes = range.count};
        if (has(range, i)) {
            const auto found = left.find(item_words(pass.gpu, i));
            if (found != left.end() && found->second > 0) {
                --found->second;
                verdict.kind = DifferenceClass::tie;
                verdict.tie = Tie{order, 0.0};
            }
        }
        verdicts.push_back(verdict);
    }
    return verdicts;
}

void AppendCause::add(const JudgedPass& pass) {
    const ItemRange range = pass.pass.appended(pass.input()).value_or(ItemRange{});
    const std::map<Words, std::size_t> right = counted(pass.reference, range), made = counted(pass.gpu, range);
    for (const auto& [words, count] : right) {
        const auto found = made.find(words);
        const std::size_t there = found == made.end() ? 0 : found->second;
        lost_ += count > there ? count - there : 0;
        doubled_ += there > count ? there - count : 0;
    }
    for (const auto& [words, count] : made)
        foreign_ += right.contains(words) ? 0 : count;
    for (const std::size_t i : differing_items(pass.reference, pass.gpu))
        foreign_ += has(range, i) ? 0 : 1;
    divergent_ = doubled_ + foreign_;
}

CauseFindings AppendCause::findings() const {
    CauseFindings found;
    found.divergent = divergent_;
    if (foreign_ == 0 && doubled_ > 0)
        found.best.push_back({{"items_doubled"}, "some items are there twice, and others are lost", divergent_});
    else if (doubled_ == 0 && lost_ > 0)
        found.best.push_back(
            {{"items_lost"}, "some items are lost, and what stands there was never appended", divergent_});
    else if (lost_ == 0)
        found.best.push_back({{"items_moved"}, "items stand where nothing is appended", divergent_});
    return found;
}

} // namespace lockstep
