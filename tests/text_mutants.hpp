#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "crosscheck/judge/check.hpp"

namespace lockstep::test {

/// A change of a shader's text, as tests/SYSTEM/mutants.json has it.
struct TextMutant {
    std::string name, file, text, replacement;
    int times = 1;          ///< how often `text` stands in `file`
    std::string run;        ///< one of the system's runs, in which the change has something to do
    std::string cause;      ///< as a report names it; empty: no one change of the twin is the same
    std::string equivalent; ///< why it is as right as the original in its run; empty: it is to be found
};

std::vector<TextMutant> text_mutants(const std::string& system);

/// What a check says of shaders.
struct Outcome {
    std::string verdict = "AGREE";
    std::vector<std::string> causes; ///< that explain everything, the likeliest first

    [[nodiscard]] bool found() const { return verdict != "AGREE" && verdict != "LEGAL"; }
    [[nodiscard]] bool names(const std::string& cause) const;
};

/// Of a check that may throw Error.
Outcome outcome_of(const std::function<CheckReport()>& check);

/// Checks a folder of shaders in a run.
using RunShaders = std::function<Outcome(const std::string& shaders, const std::string& run)>;

/// CHECKs: each text stands in the shipped shader as often as the catalogue says, and no name twice.
void check_texts(const std::string& system);
/// CHECKs: these are found, and named where they have a cause.
void check_mutants(const std::string& system, const std::set<std::string>& names, const RunShaders& run);
/// CHECKs that all are found, and prints them as a table; LOCKSTEP_ONLY_MUTANT: those whose name has it.
void check_catalogue(const std::string& system, const RunShaders& run);

} // namespace lockstep::test
