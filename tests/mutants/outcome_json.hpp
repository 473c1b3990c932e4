#pragma once
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/mutants/score.hpp"

namespace lockstep::test {

/// A score as one process hands it to another: every trial, with all that is known of it.
nlohmann::json whole_json(const Score& score);

/// Reads what whole_json() wrote. `catalogue`: the mutants by name; what a driver makes equivalent is read with them.
Score read_score(const nlohmann::json& json, const std::map<std::string, Mutant>& catalogue);

} // namespace lockstep::test
