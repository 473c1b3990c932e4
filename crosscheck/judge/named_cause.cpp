#include "crosscheck/judge/named_cause.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "crosscheck/judge/item_likeness.hpp"
#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/rounding_only.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

constexpr std::size_t first_pair_sample = 8;
constexpr std::size_t first_pairs_kept = 256;
constexpr std::size_t pair_sample = 48;
constexpr std::size_t best_pairs_kept = 8;
constexpr std::size_t alone_sample = 256;

using Items = std::vector<std::size_t>;

std::vector<JointMistake> joint(const std::vector<const NamedMistake*>& named) {
    std::vector<JointMistake> all;
    for (const NamedMistake* one : named)
        all.push_back({one->name, one->meaning, one->describes});
    return all;
}

/// The named mistakes on one frame's items.
class Evidence {
  public:
    Evidence(const JudgedPass& pass, const std::vector<const NamedMistake*>& named,
             const std::vector<ItemVerdict>& verdicts)
        : pass_(pass), named_(named), likeness_(pass, verdicts),
          errs_(pass.profile.roots == nullptr &&
                (pass.profile.errors.length > 0 || pass.profile.errors.normalize > 0)) {}

    [[nodiscard]] bool explains(const std::vector<Mistake>& made, std::size_t item) const {
        return fit(item, words_of(made, item));
    }
    /// The same, or an item that is right and may be so.
    [[nodiscard]] bool allows(const std::vector<Mistake>& made, std::size_t item) const {
        const Words words = words_of(made, item);
        return fit(item, words) || likeness_.may_be_gpus(item, words);
    }
    [[nodiscard]] std::vector<Mistake> made(const TriedCause& cause) const {
        std::vector<Mistake> all;
        for (const std::size_t mistake : cause.mistakes)
            all.push_back(named_[mistake]->mistake);
        return all;
    }
    [[nodiscard]] std::uint64_t explained(const TriedCause& cause, const Items& items) const {
        const std::vector<Mistake> all = made(cause);
        return static_cast<std::uint64_t>(
            std::count_if(items.begin(), items.end(), [&](std::size_t item) { return explains(all, item); }));
    }

    [[nodiscard]] std::uint64_t contradicted(const TriedCause& cause, const Items& right) const {
        const std::vector<Mistake> all = made(cause);
        return static_cast<std::uint64_t>(
            std::count_if(right.begin(), right.end(), [&](std::size_t item) { return !allows(all, item); }));
    }

    /// Counts, for each cause, the items it explains and contradicts.
    void count(std::vector<TriedCause>& causes, const Items& divergent, const Items& right) const {
        Items telling, others; // what is near without any mistake says nothing about one
        for (const std::size_t item : divergent)
            (is_telling(item) ? telling : others).push_back(item);
        parallel_blocks(static_cast<std::ptrdiff_t>(causes.size()), [&](std::ptrdiff_t c) {
            TriedCause& cause = causes[static_cast<std::size_t>(c)];
            const std::uint64_t found = explained(cause, telling);
            if (found == 0)
                return;
            cause.explained += found + (errs_ ? 0 : explained(cause, others));
            cause.contradicted += contradicted(cause, right);
        });
    }

    /// Whether it changes the items at hand by rounding alone, as gravity that is next to nothing does: that it has the
    /// GPU's bits says nothing.
    [[nodiscard]] bool only_rounds(std::size_t mistake, const Items& items) const {
        if (named_[mistake]->mistake.is_about_rounding())
            return false;
        const std::vector<Mistake> all = made({{mistake}});
        bool changes = false;
        for (const std::size_t item : items) {
            const Words words = words_of(all, item);
            if (!likeness_.are_near_references(item, words))
                return false;
            changes = changes || (!errs_ && !likeness_.are_references(item, words));
        }
        return changes;
    }

  private:
    using Words = std::vector<std::uint32_t>;

    [[nodiscard]] Words words_of(const std::vector<Mistake>& made, std::size_t item) const {
        return pass_.on_input().mistaken(pass_.input(), item, pass_.profile, made);
    }
    [[nodiscard]] bool fit(std::size_t item, const Words& words) const {
        return errs_ ? likeness_.ulps_from_gpus(item, words) <= rewritten_ulps
                     : likeness_.are_within_leeway(item, words);
    }
    [[nodiscard]] bool is_telling(std::size_t item) const {
        if (errs_)
            return !likeness_.is_off_by_rounding(item);
        return likeness_.is_off_by_more(item);
    }

    const JudgedPass& pass_;
    const std::vector<const NamedMistake*>& named_;
    ItemLikeness likeness_;
    bool errs_; ///< the driver, by more than the reference follows
};

} // namespace

NamedCauses::NamedCauses(std::vector<const NamedMistake*> named) : named_(std::move(named)), causes_(joint(named_)) {}

void NamedCauses::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts,
                      const SeenElsewhere& elsewhere) {
    const Items wrong = divergent_items(verdicts);
    if (wrong.empty() || named_.empty())
        return;
    const Items right = right_items(pass.gpu.count(), verdicts, JointCauses::trial_items);
    const Evidence evidence(pass, named_, verdicts);
    const auto count = [&](std::vector<TriedCause>& causes, const Items& items) {
        evidence.count(causes, items, right);
        for (TriedCause& cause : causes)
            if (elsewhere && cause.explained >= items.size() && cause.contradicted == 0) {
                std::vector<const NamedMistake*> made;
                for (const std::size_t mistake : cause.mistakes)
                    made.push_back(named_[mistake]);
                cause.contradicted += elsewhere(made);
            }
    };
    // The best of many, by a few items first: among them those that the best one alone leaves over, where another
    // shows.
    const auto best_few = [&](std::vector<TriedCause> causes) {
        if (causes.empty())
            return causes;
        const std::vector<Mistake> known = evidence.made(causes_.best_of(causes_.tried(), 1).front());
        Items rest = sample(wrong, JointCauses::trial_items);
        std::erase_if(rest, [&](std::size_t item) { return evidence.explains(known, item); });
        const auto keep_best = [&](std::size_t items, std::size_t kept) {
            const std::uint64_t before = causes.front().explained;
            Items telling = sample(rest, items);
            const Items others = sample(wrong, items);
            telling.insert(telling.end(), others.begin(), others.end());
            evidence.count(causes, telling, sample(right, items));
            causes = causes_.best_of(std::move(causes), kept);
            for (TriedCause& cause : causes) {
                cause.explained = before;
                cause.contradicted = cause.contradicted_before;
            }
        };
        keep_best(first_pair_sample, first_pairs_kept);
        keep_best(pair_sample, best_pairs_kept);
        count(causes, sample(wrong, JointCauses::trial_items));
        return causes;
    };
    Items all(named_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Items singles = all;
    if (causes_.frames() < JointCauses::trial_frames) {
        Items some = sample(wrong, alone_sample);
        const Items others = sample(right, alone_sample);
        some.insert(some.end(), others.begin(), others.end());
        std::vector<char> only_rounds(all.size());
        parallel_blocks(static_cast<std::ptrdiff_t>(all.size()), [&](std::ptrdiff_t m) {
            const auto at = static_cast<std::size_t>(m);
            only_rounds[at] = evidence.only_rounds(at, some) ? 1 : 0;
        });
        std::erase_if(singles, [&](std::size_t mistake) { return only_rounds[mistake] != 0; });
    }
    causes_.hold_against(wrong, singles, {count, [&] { return best_few(causes_.pairs()); }, best_few});
    if (causes_.frames() > JointCauses::trial_frames)
        return;
    const Items some = sample(right, alone_sample);
    std::vector<std::uint64_t> alone(all.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(all.size()), [&](std::ptrdiff_t m) {
        const auto at = static_cast<std::size_t>(m);
        alone[at] = evidence.contradicted({{at}}, some);
    });
    for (const std::size_t mistake : all)
        causes_.contradict_alone(mistake, alone[mistake]);
}

} // namespace lockstep
