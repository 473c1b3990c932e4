#pragma once
#include <string>
#include <vector>

#include "tests/mutants/trial.hpp"

namespace lockstep::test {

/// What became of the catalogue.
struct Score {
    std::string renderer;
    std::string commit;
    double seconds = 0.0;
    Outcome unmutated; ///< the shipped shaders, of which every rule has to accept every run
    std::vector<Outcome> outcomes;

    /// Mutants to be found, and those of them that were.
    [[nodiscard]] std::size_t wanted() const;
    [[nodiscard]] std::size_t killed() const;
    /// Those that a rule had an end to judge of, and rejected.
    [[nodiscard]] std::size_t judged_by(std::size_t rule) const;
    [[nodiscard]] std::size_t rejected_by(std::size_t rule) const;
    /// Mutants that are a hypothesis, those named first, and mutants of which something else is claimed to explain all.
    [[nodiscard]] std::size_t hypotheses() const;
    [[nodiscard]] std::size_t named() const;
    [[nodiscard]] std::size_t wrongly_named() const;
    /// Of the trials of mutants whose mistake has a name, those of which the run's power said that it would show
    /// (`predicted`), or could not, and that found it or not.
    [[nodiscard]] std::size_t trials(bool predicted, bool found) const;
    /// Equivalent ones that differ all the same.
    [[nodiscard]] std::size_t false_alarms() const;

    /// Every mutant found, 95 in 100 hypotheses named first, none wrongly, and nothing said of what is right.
    [[nodiscard]] bool is_full() const;
};

/// One line of one mutant: name, verdict, scene and frame, cause.
std::string outcome_line(const Outcome& outcome);

/// The sums, as a few lines of text.
std::string score_text(const Score& score);

/// Everything, as a page of tables.
std::string score_markdown(const Score& score);

/// Everything as JSON, a mutant a line; trials that found nothing are left out.
std::string score_json(const Score& score);

} // namespace lockstep::test
