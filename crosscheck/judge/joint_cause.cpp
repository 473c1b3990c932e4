#include "crosscheck/judge/joint_cause.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "crosscheck/judge/item_sample.hpp"

namespace lockstep {
namespace {

constexpr std::size_t whole_kept = 8;
constexpr std::ptrdiff_t parts_kept = 8;
constexpr std::size_t most_together = 3;
constexpr std::uint64_t borne_out = 64; ///< items that a cause explains before it is tried with another

/// More explained than contradicted; then the simpler.
bool better(const TriedCause& a, const TriedCause& b) {
    const auto balance = [](const TriedCause& c) {
        return static_cast<std::int64_t>(c.contradicted) - static_cast<std::int64_t>(c.explained);
    };
    return std::tuple(balance(a), a.mistakes.size()) < std::tuple(balance(b), b.mistakes.size());
}

bool is_whole(const TriedCause& cause, std::uint64_t divergent) {
    return cause.explained == divergent && cause.contradicted == 0;
}

} // namespace

JointCauses::JointCauses(std::vector<JointMistake> mistakes)
    : mistakes_(std::move(mistakes)), alone_(mistakes_.size()) {}

bool JointCauses::describes(const TriedCause& cause) const {
    return std::all_of(cause.mistakes.begin(), cause.mistakes.end(),
                       [&](std::size_t mistake) { return mistakes_[mistake].describes; });
}

/// `better`, with what says more of what is seen before its equals.
bool JointCauses::before(const TriedCause& a, const TriedCause& b) const {
    const auto guesses = [&](const TriedCause& cause) {
        return std::count_if(cause.mistakes.begin(), cause.mistakes.end(),
                             [&](std::size_t mistake) { return !mistakes_[mistake].describes; });
    };
    return better(a, b) || (!better(b, a) && guesses(a) < guesses(b));
}

std::vector<TriedCause> JointCauses::best_of(std::vector<TriedCause> causes, std::size_t count) const {
    std::stable_sort(causes.begin(), causes.end(),
                     [&](const TriedCause& a, const TriedCause& b) { return before(a, b); });
    if (causes.size() > count)
        causes.resize(count);
    return causes;
}

std::vector<TriedCause> JointCauses::pairs() const {
    std::vector<TriedCause> causes;
    for (std::size_t a = 0; a < tried_.size(); ++a)
        for (std::size_t b = a + 1; b < tried_.size(); ++b)
            if (tried_[a].mistakes.size() == 1 && tried_[b].mistakes.size() == 1)
                causes.push_back({{tried_[a].mistakes.front(), tried_[b].mistakes.front()}});
    return causes;
}

std::vector<TriedCause> JointCauses::whole_ones() const {
    std::vector<TriedCause> whole = best_of(tried_, whole_kept);
    std::erase_if(whole, [&](const TriedCause& cause) { return !is_whole(cause, divergent_); });
    return whole;
}

/// What has failed to explain everything stays so: only the best of that is kept, to be told as a part.
void JointCauses::drop_hopeless() {
    std::stable_sort(tried_.begin(), tried_.end(),
                     [&](const TriedCause& a, const TriedCause& b) { return before(a, b); });
    const auto failed = std::stable_partition(tried_.begin(), tried_.end(),
                                              [&](const TriedCause& cause) { return is_whole(cause, divergent_); });
    if (tried_.end() - failed > parts_kept)
        tried_.erase(failed + parts_kept, tried_.end());
}

/// Whether what explained all items before may be tried with one more. Where that only says what is seen, as that
/// nothing collides, its names are guesses.
bool JointCauses::is_base(const std::vector<TriedCause>& held, std::uint64_t divergent_before) const {
    return !held.empty() && divergent_before >= borne_out &&
           std::none_of(held.begin(), held.end(), [&](const TriedCause& cause) { return describes(cause); });
}

/// Each with each single that it does not have.
std::vector<TriedCause> JointCauses::with_one_more(const std::vector<TriedCause>& causes,
                                                   const std::vector<std::size_t>& singles) const {
    std::vector<TriedCause> longer;
    for (const TriedCause& cause : causes)
        for (const std::size_t one : singles) {
            if (cause.mistakes.size() >= most_together ||
                std::find(cause.mistakes.begin(), cause.mistakes.end(), one) != cause.mistakes.end())
                continue;
            TriedCause& more = longer.emplace_back(cause);
            more.mistakes.push_back(one);
            std::sort(more.mistakes.begin(), more.mistakes.end());
            more.contradicted_before += alone_[one];
            more.contradicted = more.contradicted_before;
        }
    std::stable_sort(longer.begin(), longer.end(),
                     [](const TriedCause& a, const TriedCause& b) { return a.mistakes < b.mistakes; });
    longer.erase(std::unique(longer.begin(), longer.end(),
                             [](const TriedCause& a, const TriedCause& b) { return a.mistakes == b.mistakes; }),
                 longer.end());
    return longer;
}

void JointCauses::hold_against(const std::vector<std::size_t>& divergent, const std::vector<std::size_t>& singles,
                               const JointEvidence& evidence) {
    if (divergent.empty())
        return;
    const bool first = frames_ == 0, later = frames_ >= trial_frames;
    ++frames_;
    std::vector<TriedCause> held = first ? std::vector<TriedCause>() : whole_ones();
    if (later && held.empty())
        return;
    if (later)
        tried_ = held;
    for (const std::size_t single : singles)
        if (first)
            tried_.push_back({{single}});
    const std::vector<std::size_t> some = sample(divergent, trial_items);
    evidence.count(tried_, some);
    const std::uint64_t before_frame = divergent_;
    divergent_ += some.size();
    if (whole_ones().empty() && extensions_ < trial_frames && (first || is_base(held, before_frame))) {
        ++extensions_;
        /// Adds causes that were counted in this frame, and has them ready for one more.
        const auto add = [&](std::vector<TriedCause> causes) {
            tried_.insert(tried_.end(), causes.begin(), causes.end());
            for (TriedCause& cause : causes) {
                cause.explained = before_frame;
                cause.contradicted = cause.contradicted_before;
            }
            held = std::move(causes);
        };
        if (first)
            add(evidence.pairs());
        for (int more = first ? 1 : 0; more < 2 && whole_ones().empty(); ++more)
            add(evidence.best(with_one_more(held, singles)));
    }
    drop_hopeless();
    std::vector<TriedCause> whole = whole_ones();
    if (whole.empty() || some.size() == divergent.size())
        return;
    std::vector<std::size_t> rest;
    std::set_difference(divergent.begin(), divergent.end(), some.begin(), some.end(), std::back_inserter(rest));
    evidence.count(whole, rest);
    divergent_ += rest.size();
    tried_ = std::move(whole);
}

Cause JointCauses::as_cause(const TriedCause& tried) const {
    Cause cause{{}, {}, tried.explained, tried.contradicted};
    for (const std::size_t mistake : tried.mistakes) {
        if (tried.mistakes.size() > 1 && mistakes_[mistake].name == left_out_)
            continue;
        cause.mistakes.push_back(mistakes_[mistake].name);
        cause.meaning += (cause.meaning.empty() ? "" : "; ") + mistakes_[mistake].meaning;
    }
    return cause;
}

CauseFindings JointCauses::findings() const {
    CauseFindings found;
    found.divergent = divergent_;
    const std::vector<TriedCause> sorted = best_of(tried_, tried_.size());
    for (const TriedCause& cause : sorted) {
        if (cause.explained == 0 || (!found.best.empty() && better(sorted.front(), cause)))
            break;
        found.best.push_back(as_cause(cause));
    }
    return found;
}

} // namespace lockstep
