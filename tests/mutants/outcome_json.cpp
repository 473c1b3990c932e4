#include "tests/mutants/outcome_json.hpp"

#include <utility>

namespace lockstep::test {
namespace {

/// True, false, or null for nothing.
nlohmann::json json_of(const std::optional<bool>& value) { return value ? nlohmann::json(*value) : nlohmann::json(); }

std::optional<bool> flag_of(const nlohmann::json& json) {
    return json.is_null() ? std::nullopt : std::optional<bool>(json.get<bool>());
}

nlohmann::json json_of(const Trial& trial) {
    nlohmann::json rules = nlohmann::json::array();
    for (const std::optional<bool>& rule : trial.rules)
        rules.push_back(json_of(rule));
    return {{"scene", trial.scene},         {"verdict", trial.verdict},
            {"error", trial.error},         {"frame", trial.frame},
            {"divergent", trial.divergent}, {"explained", trial.explained},
            {"causes", trial.causes},       {"predicted", json_of(trial.predicted)},
            {"step", trial.step},           {"rules", rules}};
}

Trial trial_of(const nlohmann::json& json) {
    Trial trial;
    trial.scene = json.at("scene");
    trial.verdict = json.at("verdict");
    trial.error = json.at("error");
    trial.frame = json.at("frame");
    trial.divergent = json.at("divergent");
    trial.explained = json.at("explained");
    trial.causes = json.at("causes").get<std::vector<std::string>>();
    trial.predicted = flag_of(json.at("predicted"));
    trial.step = json.at("step");
    for (std::size_t rule = 0; rule < trial.rules.size(); ++rule)
        trial.rules[rule] = flag_of(json.at("rules").at(rule));
    return trial;
}

nlohmann::json json_of(const Outcome& outcome) {
    nlohmann::json trials = nlohmann::json::array();
    for (const Trial& trial : outcome.trials)
        trials.push_back(json_of(trial));
    return {{"name", outcome.mutant.name}, {"equivalent", outcome.mutant.equivalent}, {"trials", trials}};
}

Outcome outcome_of(const nlohmann::json& json, Mutant mutant) {
    Outcome outcome{std::move(mutant), {}};
    outcome.mutant.equivalent = json.at("equivalent");
    for (const nlohmann::json& trial : json.at("trials"))
        outcome.trials.push_back(trial_of(trial));
    return outcome;
}

} // namespace

nlohmann::json whole_json(const Score& score) {
    nlohmann::json outcomes = nlohmann::json::array();
    for (const Outcome& outcome : score.outcomes)
        outcomes.push_back(json_of(outcome));
    return {{"renderer", score.renderer}, {"unmutated", json_of(score.unmutated)}, {"outcomes", outcomes}};
}

Score read_score(const nlohmann::json& json, const std::map<std::string, Mutant>& catalogue) {
    Score score;
    score.renderer = json.at("renderer");
    score.unmutated = outcome_of(json.at("unmutated"), {});
    for (const nlohmann::json& outcome : json.at("outcomes"))
        score.outcomes.push_back(outcome_of(outcome, catalogue.at(outcome.at("name"))));
    return score;
}

} // namespace lockstep::test
