#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reference/subnormals.hpp"
#include "reference/text/machine.hpp"
#include "reference/text/outcomes.hpp"
#include "reference/text/text_worlds.hpp"

namespace lockstep::text {

/// Invocations of a text by sets, one after the other. What `bindings` name stays as it is.
class SetsRun {
    FlushSubnormals flushes_;
    TextWorlds worlds_;
    Findings ignored_;
    Memory memory_;

  public:
    /// All outlive it. `sites`: of each step.
    SetsRun(const Program& program, std::array<std::uint32_t, 3> groups, const Bindings& bindings, PassStage stage,
            const Profile& profile, const KnownOperations& known, Constants constants,
            std::span<const Site* const> sites);

    Machine<TextWorlds, 1> machine;
    WrittenWords<TextWorlds> written; ///< by the run, since it was cleared

    /// Runs each way of an invocation; behind `most` of them the rest is undecided. `begin()`: before each.
    /// `ended(whether it came to its end, forks, undefined)`.
    void ways(const Invocation& invocation, std::span<const GivenInput> inputs, const std::function<void()>& begin,
              const std::function<void(bool is_at_end, std::span<const Fork> forks, Undefined undefined)>& ended,
              int most = TextWorlds::most_runs);
};

/// A word as a way has left it.
WrittenWord written_word(const WrittenPlace& place, const Cell<TextWorlds>& cell);
/// What a way of an invocation leaves outside: images hold what is stored in them.
InvocationOutcome outcome_of(const WrittenWords<TextWorlds>& written, const Bindings& bindings,
                             std::span<const Fork> forks, Undefined undefined);
/// Adds an outcome that is not among them.
void add_outcome(InvocationOutcome one, std::vector<InvocationOutcome>& found);

} // namespace lockstep::text
