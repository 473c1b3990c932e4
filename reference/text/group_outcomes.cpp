#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "reference/text/group_memory.hpp"
#include "reference/text/sets_run.hpp"

namespace lockstep::text {
namespace {

using Space = WrittenPlace::Space;

/// What a group leaves in its words, each from a moment on: of its start 0, behind its first barrier 1.
using History = std::map<WrittenPlace, std::map<std::size_t, GroupWord>>;

const GroupWord* found_at(const History& history, const WrittenPlace& place, std::size_t moment) {
    const auto of_place = history.find(place);
    if (of_place == history.end())
        return nullptr;
    const auto after = of_place->second.upper_bound(moment);
    return after == of_place->second.begin() ? nullptr : &std::prev(after)->second;
}

Interval as_set(const GroupWord& a) {
    return a.set ? *a.set : word_range::floats(a.words).value_or(Interval::anything());
}

/// Every word of both, and perhaps more.
GroupWord joined(const GroupWord& a, const GroupWord& b) {
    if (a.undefined != Undefined::none || b.undefined != Undefined::none)
        return a.undefined != Undefined::none ? a : b;
    if (a.set || b.set)
        return {a.words, interval::hull(as_set(a), as_set(b))};
    const auto around = [&](const WordRange& x, const WordRange& y) {
        return WordRange{x.first, std::max(x.more, y.first - x.first + y.more)};
    };
    const WordRange up = around(a.words, b.words), down = around(b.words, a.words);
    return {up.more < down.more ? up : down};
}

bool are_same(const GroupWord& a, const GroupWord& b) {
    if (a.is_one_word() && b.is_one_word())
        return a.words == b.words || ((a.set || b.set) && as_set(a).low == as_set(b).low); // both zeros
    if (a.set.has_value() != b.set.has_value() || a.undefined != b.undefined)
        return false;
    return a.set ? a.set->low == b.set->low && a.set->high == b.set->high && a.set->any == b.set->any
                 : a.words == b.words;
}

/// Whether they say the same of what some stretch finds.
bool are_same(const History& a, const History& b, std::size_t stretches) {
    return std::ranges::equal(a, b, [&](const auto& x, const auto& y) {
        const auto is_found = [&](const auto& left) { return left.first < stretches; };
        return x.first == y.first && std::ranges::equal(x.second, y.second, [&](const auto& one, const auto& other) {
                   return one.first == other.first && (!is_found(one) || are_same(one.second, other.second));
               });
    });
}

/// The word that atomic operations change; nothing: it is written.
std::optional<WrittenPlace> changed_place(WrittenPlace place) {
    switch (place.space) {
    case Space::changed_shared:
        place.space = Space::shared;
        return place;
    case Space::changed_block:
        place.space = Space::block;
        return place;
    case Space::changed_texel:
        place.space = Space::texel;
        return place;
    default:
        return {};
    }
}

/// What the invocations of a group make of shared words together by atomic operations whose order says nothing.
class Changes {
  public:
    void add(std::uint64_t word, std::size_t moment, std::uint32_t op, const WordRange& operand, bool is_sure) {
        Change& change = changes_[{word, moment}];
        if (change.op != 0 && change.op != op)
            refuse();
        change.op = op;
        change.operands.emplace_back(operand, is_sure);
    }
    /// `before(place, moment)`, `put(place, moment, word)`: as of Stretches.
    template <class Before, class Put> void leave(const Before& before, const Put& put) const {
        for (const auto& [at, change] : changes_) {
            const WrittenPlace place{Space::shared, 0, at.first};
            const GroupWord start = before(place, at.second - 1);
            const std::optional<WordRange> first = start.undefined != Undefined::none  ? std::nullopt
                                                   : start.is_one_word() || !start.set ? std::optional(start.words)
                                                                                       : word_range::bits(*start.set);
            if (!first)
                refuse();
            std::optional<WordRange> made = first;
            for (const auto& [operand, is_sure] : change.operands) {
                const std::optional<WordRange> with = word_range::of_atomic(change.op, *made, operand);
                if (!with)
                    refuse();
                made = is_sure ? *with : joined({*made}, {*with}).words;
            }
            put(place, at.second, {*made});
        }
    }

  private:
    [[noreturn]] static void refuse() {
        throw Error("what an atomic operation makes of open words is not followed by sets");
    }
    struct Change {
        std::uint32_t op = 0;
        std::vector<std::pair<WordRange, bool>> operands;
    };
    std::map<std::pair<std::uint64_t, std::size_t>, Change> changes_;
};

/// What one invocation leaves in the stretches of its group, all its ways together.
class Stretches {
  public:
    /// Takes up a way: what it wrote in each stretch that it came through.
    void add(const std::vector<WrittenWords<TextWorlds>>& way) {
        ++ways_;
        for (std::size_t stretch = 0; stretch < way.size(); ++stretch)
            for (const auto& [place, cell] : way[stretch]) {
                const WrittenWord one = written_word(place, cell);
                const GroupWord word{{one.word, one.more}, one.is_real ? std::optional(one.set) : std::nullopt};
                const auto [known, is_new] = left_[place].try_emplace(stretch, Left{word, 0});
                known->second.ways += 1;
                if (!is_new)
                    known->second.word = joined(known->second.word, word);
            }
    }
    /// A way does not come through this stretch.
    void end_in(std::size_t stretch, Undefined why) {
        if (stretch < ends_)
            ends_ = stretch, why_ = why;
    }
    /// Of a stretch that is left with what only some ways write, `before(place, stretch)` is what lay there;
    /// `plain(place, moment)`: what the group leaves in plain bits, or null. Calls put(place, moment, word). Throws
    /// Error where what an atomic operation makes is open.
    template <class Before, class Plain, class Put>
    void leave(const Before& before, const Plain& plain, const Put& put, Changes& changes) const {
        for (const auto& [place, of_place] : left_)
            for (const auto& [stretch, left] : of_place) {
                if (stretch >= ends_)
                    continue;
                if (place.space == Space::changed_shared && place.number != 0) {
                    changes.add(place.word, stretch + 1, place.number, left.word.words, left.ways == ways_);
                } else if (const std::optional<WrittenPlace> changed = changed_place(place)) {
                    const GroupWord* const made = plain(*changed, stretch + 1);
                    if (made == nullptr || left.ways != ways_ || !left.word.is_one_word() ||
                        !before(*changed, stretch).is_one_word())
                        throw Error("what an atomic operation makes of open words is not followed by sets");
                    put(*changed, stretch + 1, *made);
                } else {
                    put(place, stretch + 1, left.ways == ways_ ? left.word : joined(left.word, before(place, stretch)));
                }
            }
    }
    [[nodiscard]] std::size_t ends() const { return ends_; }
    [[nodiscard]] Undefined why() const { return why_; }

  private:
    struct Left {
        GroupWord word;
        int ways = 0; ///< that write it
    };
    std::map<WrittenPlace, std::map<std::size_t, Left>> left_;
    int ways_ = 0;
    std::size_t ends_ = std::numeric_limits<std::size_t>::max();
    Undefined why_ = Undefined::none;
};

GroupWord word_before(const Bindings& bindings, const WrittenPlace& place) {
    const std::span<const std::uint32_t> words = place.space == Space::block   ? bindings.blocks[place.number]
                                                 : place.space == Space::texel ? bindings.images[place.number].words
                                                                               : std::span<const std::uint32_t>();
    return {{place.word < words.size() ? words[place.word] : 0U, 0}};
}

} // namespace

// What each invocation finds behind a barrier is taken from a history of the group, at first that of plain bits, and
// makes the next history, until the two are one: up to the first moment that an open word changes they are final, so
// that each round has at least one moment more. Tiles of loaded words take one round.
std::vector<std::vector<InvocationOutcome>> Outcomes::of_group(std::uint32_t group, std::array<std::uint32_t, 3> groups,
                                                               const Bindings& bindings, const Profile& profile,
                                                               const KnownOperations& known,
                                                               Constants constants) const {
    const std::vector<std::vector<GroupWrite>> writes = group_writes(program_, groups, bindings, profile, group);
    History plain;
    for (std::size_t stretch = 0; stretch < writes.size(); ++stretch)
        for (const GroupWrite& one : writes[stretch])
            plain[one.place][stretch + 1] = {{one.word, 0}};
    SetsRun run(program_, groups, bindings, PassStage::compute, profile, known, constants, site_of_step_);
    History history = plain;
    std::size_t at = 0; // the stretch that runs
    std::vector<WrittenWords<TextWorlds>> way;
    run.machine.meet([&] {
        way.push_back(std::exchange(run.written, {}));
        return ++at < writes.size();
    });
    run.machine.find([&](const WrittenPlace& place) { return found_at(history, place, at); });
    const auto before = [&](const WrittenPlace& place, std::size_t moment) {
        const GroupWord* const found = found_at(history, place, moment);
        return found != nullptr ? *found : word_before(bindings, place);
    };
    constexpr int most_ways = 8; // of an invocation, on average
    const std::uint32_t size = program_.invocations();
    std::vector<bool> is_given_up(size); // from then on: what it leaves is anything, in every round
    for (std::size_t round = 0; round <= writes.size() + size; ++round) {
        std::vector<std::vector<InvocationOutcome>> outcomes(size);
        History next;
        Changes changes;
        const auto put = [&](const WrittenPlace& place, std::size_t moment, const GroupWord& word) {
            const auto [known_word, is_new] = next[place].try_emplace(moment, word);
            if (!is_new)
                known_word->second = joined(known_word->second, word);
        };
        int ways_left = most_ways * static_cast<int>(size);
        for (std::uint32_t i = 0; i < size; ++i) {
            Stretches stretches;
            const auto ended = [&](bool is_at_end, std::span<const Fork> forks, Undefined undefined) {
                --ways_left;
                is_given_up[i] = is_given_up[i] || (!is_at_end && undefined == Undefined::undecided);
                if (is_at_end)
                    way.push_back(run.written);
                else
                    stretches.end_in(is_given_up[i] ? 0 : at, undefined);
                stretches.add(way);
                WrittenWords<TextWorlds> all;
                if (is_at_end)
                    for (const WrittenWords<TextWorlds>& stretch : way)
                        for (const auto& [place, cell] : stretch)
                            all[place] = cell;
                add_outcome(outcome_of(all, bindings, forks, undefined), outcomes[i]);
            };
            const auto begin = [&] {
                at = 0;
                way.clear();
            };
            begin();
            if (is_given_up[i])
                ended(false, {}, Undefined::undecided);
            else
                run.ways(invocation_of(program_, groups, group * size + i), {}, begin, ended,
                         std::clamp(ways_left, 4, TextWorlds::most_runs));
            stretches.leave(
                before, [&](const WrittenPlace& place, std::size_t moment) { return found_at(plain, place, moment); },
                put, changes);
            // It could go on either way: what it has written somewhere, it may write there as well.
            for (std::size_t stretch = 0; stretches.ends() < writes.size() && stretch < writes.size(); ++stretch)
                for (const GroupWrite& one : writes[stretch])
                    if (one.invocation == group * size + i)
                        put(one.place, std::max(stretch, stretches.ends()) + 1, {.undefined = stretches.why()});
        }
        changes.leave(before, put);
        if (are_same(history, next, writes.size()))
            return outcomes;
        history = std::move(next);
    }
    throw Error("what a group shares is not followed by sets");
}

namespace {

/// Whether most invocations of a group have more ways than are followed.
bool is_undecided(std::span<const std::vector<InvocationOutcome>> group) {
    const auto undecided = std::ranges::count_if(group, [](const std::vector<InvocationOutcome>& all) {
        return std::ranges::any_of(all, [](const auto& one) { return one.undefined == Undefined::undecided; });
    });
    return 2 * undecided > static_cast<std::ptrdiff_t>(group.size());
}

} // namespace

std::shared_ptr<const DispatchOutcomes::Group> DispatchOutcomes::kept(std::uint32_t number) const {
    constexpr std::size_t most_kept = 1024;
    {
        const std::scoped_lock lock(mutex_);
        if (const auto found = groups_.find(number); found != groups_.end())
            return found->second;
    }
    auto made = std::make_shared<Group>();
    const JudgedDispatch& d = dispatch_;
    try {
        made->outcomes = of_.of_group(number, d.groups, bindings_, d.profile, d.known, d.constants);
    } catch (const Error& error) {
        made->refused = error.what();
    }
    const std::scoped_lock lock(mutex_);
    if (groups_.size() >= most_kept)
        groups_.clear();
    return groups_.try_emplace(number, std::move(made)).first->second;
}

std::vector<InvocationOutcome> DispatchOutcomes::of(const Invocation& invocation,
                                                    std::span<const GivenInput> inputs) const {
    const JudgedDispatch& d = dispatch_;
    const Program& program = of_.program();
    if (program.barriers == 0 && program.shared == 0)
        return of_.of(invocation, d.groups, bindings_, d.stage, d.profile, d.known, d.constants, inputs);
    // What takes long and comes to nothing is known by three groups, the same ones whoever asks first.
    std::call_once(is_looked_at_, [&] {
        const std::uint32_t count = d.groups[0] * d.groups[1] * d.groups[2];
        const std::array some{kept(0), kept(count / 2), kept(count - 1)};
        are_undecided_ = std::ranges::all_of(some, [](const auto& one) { return is_undecided(one->outcomes); });
        if (std::ranges::none_of(some, [](const auto& one) { return one->refused.empty(); }))
            refused_ = some[0]->refused;
    });
    if (!refused_.empty())
        throw Error(refused_);
    if (are_undecided_)
        return {{.written = {}, .open = {}, .undefined = Undefined::undecided}};
    const std::shared_ptr<const Group> group = kept(invocation.number / program.invocations());
    if (!group->refused.empty())
        throw Error(group->refused);
    return group->outcomes.at(invocation.number % program.invocations());
}

} // namespace lockstep::text
