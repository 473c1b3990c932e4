#include "tests/mutants/score.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace lockstep::test {
namespace {

template <class Condition> std::size_t count(const std::vector<Outcome>& outcomes, const Condition& condition) {
    return static_cast<std::size_t>(std::count_if(outcomes.begin(), outcomes.end(), condition));
}

bool is_wanted(const Outcome& outcome) { return outcome.mutant.equivalent.empty(); }

/// Whether the run's power says something of the mutant: its mistake has a name, and the host did not notice by itself.
bool is_power_trial(const Outcome& outcome, const Trial& trial) {
    return is_wanted(outcome) && trial.predicted.has_value() && trial.verdict != "ERROR" && trial.verdict != "PIXELS";
}

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string of(std::size_t part, std::size_t whole) {
    return fmt::format("{} of {} ({:.1f} %)", part, whole, percent(part, whole));
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
    return fmt::format("{}", fmt::join(words, separator));
}

/// What is said of the cause: equals side by side.
std::string cause_text(const Trial& trial) {
    if (trial.explained)
        return joined(trial.causes, " = ");
    return trial.causes.empty() ? std::string() : fmt::format("in part {}", trial.causes.front());
}

std::string place(const Trial& trial) {
    return trial.frame < 0 ? trial.scene : fmt::format("{}, frame {}", trial.scene, trial.frame);
}

/// Inside a cell of a table.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|')
            escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string mark(const Outcome& outcome, std::size_t rule) {
    if (!outcome.judged_by(rule))
        return "-";
    return outcome.rejected_by(rule) ? "x" : "";
}

} // namespace

std::size_t Score::wanted() const { return count(outcomes, is_wanted); }

std::size_t Score::killed() const {
    return count(outcomes, [](const Outcome& o) { return is_wanted(o) && o.killer() != nullptr; });
}

std::size_t Score::judged_by(std::size_t rule) const {
    return count(outcomes, [&](const Outcome& o) { return is_wanted(o) && o.judged_by(rule); });
}

std::size_t Score::rejected_by(std::size_t rule) const {
    return count(outcomes, [&](const Outcome& o) { return is_wanted(o) && o.rejected_by(rule); });
}

std::size_t Score::hypotheses() const {
    return count(outcomes, [](const Outcome& o) { return is_wanted(o) && !o.mutant.cause.empty(); });
}

std::size_t Score::named() const {
    return count(outcomes, [](const Outcome& o) { return !o.mutant.cause.empty() && o.named(); });
}

std::size_t Score::wrongly_named() const {
    return count(outcomes, [](const Outcome& o) { return o.wrongly_named(); });
}

std::size_t Score::trials(bool predicted, bool found) const {
    std::size_t sum = 0;
    for (const Outcome& outcome : outcomes)
        for (const Trial& trial : outcome.trials)
            sum += is_power_trial(outcome, trial) && trial.predicted == predicted && trial.killed() == found ? 1 : 0;
    return sum;
}

std::size_t Score::false_alarms() const {
    return count(outcomes, [](const Outcome& o) { return !is_wanted(o) && o.killer() != nullptr; }) +
           (unmutated.killer() != nullptr ? 1 : 0);
}

bool Score::is_full() const {
    return killed() == wanted() && 100 * named() >= 95 * hypotheses() && wrongly_named() == 0 && false_alarms() == 0;
}

std::string outcome_line(const Outcome& outcome) {
    const Trial* trial = outcome.killer();
    const std::string name = fmt::format("{:<34}", outcome.mutant.name);
    if (trial == nullptr)
        return name + (is_wanted(outcome) ? "SURVIVES" : "equivalent");
    std::string line = fmt::format("{}{:<16} {:<24} {}", name, trial->verdict, place(*trial), cause_text(*trial));
    if (!trial->error.empty())
        line += trial->error;
    if (!is_wanted(outcome))
        line += " BUT IS EQUIVALENT";
    if (!outcome.mutant.cause.empty() && !outcome.named())
        line += fmt::format(" NOT NAMED {}", outcome.mutant.cause);
    if (outcome.wrongly_named())
        for (const Trial& other : outcome.trials)
            if (other.explained && !outcome.mutant.is_called(other.causes.front()) &&
                std::find(other.causes.begin(), other.causes.end(), outcome.mutant.cause) == other.causes.end())
                line += fmt::format(" WRONGLY NAMED {} in {}", joined(other.causes, " = "), other.scene);
    return line;
}

std::string score_text(const Score& score) {
    std::string text =
        fmt::format("renderer      {}\nrun           {} mutants in {} scenes of {} frames, {:.0f} s\n", score.renderer,
                    score.outcomes.size(), score.unmutated.trials.size(), trial_frames, score.seconds);
    text +=
        fmt::format("verdict       {} found; {} false alarms on {} equivalent mutants and the shipped shaders\n",
                    of(score.killed(), score.wanted()), score.false_alarms(), score.outcomes.size() - score.wanted());
    text += fmt::format("cause         {} named first; {} wrongly named\n", of(score.named(), score.hypotheses()),
                        score.wrongly_named());
    text += fmt::format(
        "power         {} found and {} missed that would have shown; {} found and {} missed that could not\n",
        score.trials(true, true), score.trials(true, false), score.trials(false, true), score.trials(false, false));
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        text += fmt::format("{:<14}{} found\n", common_rules()[rule].name,
                            of(score.rejected_by(rule), score.judged_by(rule)));
    return text;
}

std::string score_markdown(const Score& score) {
    std::string text =
        "# Mutants\n\nWritten by `scripts/mutation_score.sh`; the catalogue is `tests/mutants/*.json`.\n\n";
    text +=
        fmt::format("{}, commit {}: {} mutants, each in {} scenes of {} frames (`tests/mutants/scenes`), {:.0f} s.\n\n",
                    score.renderer, score.commit, score.outcomes.size(), score.unmutated.trials.size(), trial_frames,
                    score.seconds);
    text += "| rule | found | what it accepts |\n|---|---|---|\n";
    text +=
        fmt::format("| **lockstep's verdict** | **{}** | every bit after every frame, from the GPU's own state; what "
                    "differs if a legal run explains it |\n",
                    of(score.killed(), score.wanted()));
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        text += fmt::format("| {} | {} | {} |\n", common_rules()[rule].name,
                            of(score.rejected_by(rule), score.judged_by(rule)), common_rules()[rule].meaning);
    text +=
        fmt::format("\nThe other rules compare the end of the same GPU runs with that of the reference's own run from "
                    "the same start; a mutant counts as found if any scene shows it. `-`: the run had no end to "
                    "compare, since the host noticed an error.\n\n");
    text += fmt::format(
        "Cause: of the mutants that are a hypothesis (`reference/collision/deviation.hpp`), {} are named first; {} "
        "are said to be explained by something else. False alarms, on {} equivalent mutants and the "
        "shipped shaders: {}.\n\n",
        of(score.named(), score.hypotheses()), score.wrongly_named(), score.outcomes.size() - score.wanted(),
        score.false_alarms());
    text += "## Predicted against found\n\nThe runs of mutants whose mistake has a name: what the line `power` of the "
            "shipped "
            "shaders' run in that scene says of the mistake, and whether the verdict found the mutant there.\n\n"
            "| | found | not found |\n|---|---|---|\n";
    for (const bool predicted : {true, false})
        text += fmt::format("| {} | {} | {} |\n", predicted ? "would have shown" : "could not show",
                            score.trials(predicted, true), score.trials(predicted, false));
    text += "\n";
    for (const Outcome& outcome : score.outcomes)
        for (const Trial& trial : outcome.trials)
            if (is_power_trial(outcome, trial) && trial.predicted != trial.killed())
                text += fmt::format(
                    "- {} in {}: {}\n", outcome.mutant.name, place(trial),
                    trial.killed() ? fmt::format("found in {} items, which the power's sample missed", trial.divergent)
                                   : "not found, though it would have shown");
    text += "\nNot counted, since there the change is not the mistake that it is called:\n\n";
    for (const Outcome& outcome : score.outcomes)
        for (const auto& [scene, why] : outcome.mutant.differs_in)
            text += fmt::format("- {} in {}: {}\n", outcome.mutant.name, scene, why);
    text += "\n## Found\n\nThe first scene that finds a mutant, and what explains everything there (equals side by "
            "side). x: "
            "found by that rule.\n\n| mutant | in | verdict | scene, frame | cause |";
    for (const CommonRule& rule : common_rules())
        text += fmt::format(" {} |", rule.name);
    text += "\n|---|---|---|---|---|";
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        text += "---|";
    text += "\n";
    for (const Outcome& outcome : score.outcomes) {
        const Trial* trial = outcome.killer();
        if (!is_wanted(outcome))
            continue;
        if (trial == nullptr) {
            text += fmt::format("| {} | {} | SURVIVES | | |", outcome.mutant.name, outcome.mutant.where());
        } else {
            const std::string cause = trial->explained ? joined(trial->causes, " = ") : "";
            text += fmt::format("| {} | {} | {} | {} | {} |", outcome.mutant.name, outcome.mutant.where(),
                                trial->verdict, place(*trial), cell(trial->error.empty() ? cause : trial->error));
        }
        for (std::size_t rule = 0; rule < common_rule_count; ++rule)
            text += fmt::format(" {} |", mark(outcome, rule));
        text += "\n";
    }
    text += "\n## Equivalent\n\nThese are as right as the shipped program; the runs agree, or are legal.\n\n| mutant | "
            "in | "
            "proof |\n|---|---|---|\n";
    for (const Outcome& outcome : score.outcomes)
        if (!is_wanted(outcome))
            text += fmt::format("| {} | {} | {} |\n", outcome.mutant.name, outcome.mutant.where(),
                                cell(outcome.mutant.equivalent));
    return text;
}

namespace {

nlohmann::json trial_json(const Trial& trial) {
    std::vector<std::string_view> rejecting;
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        if (trial.rules[rule] == false)
            rejecting.push_back(common_rules()[rule].name);
    nlohmann::json json{{"scene", trial.scene}, {"verdict", trial.verdict}};
    if (trial.rules[0])
        json["rejected_by"] = rejecting;
    if (trial.frame >= 0)
        json["frame"] = trial.frame;
    if (!trial.error.empty())
        json["error"] = trial.error;
    if (trial.predicted)
        json["predicted"] = *trial.predicted;
    if (!trial.step.empty())
        json["step"] = trial.step;
    if (trial.divergent > 0)
        json["divergent"] = trial.divergent;
    if (!trial.causes.empty())
        json[trial.explained ? "cause" : "cause_in_part"] =
            trial.explained ? trial.causes : std::vector{trial.causes.front()};
    return json;
}

nlohmann::json outcome_json(const Outcome& outcome) {
    nlohmann::json json{{"name", outcome.mutant.name}, {"in", outcome.mutant.where()}};
    if (!outcome.mutant.cause.empty())
        json["cause"] = outcome.mutant.cause;
    if (!outcome.mutant.equivalent.empty())
        json["equivalent"] = outcome.mutant.equivalent;
    json["found"] = nlohmann::json::array();
    for (const Trial& trial : outcome.trials)
        if (trial.killed())
            json["found"].push_back(trial_json(trial));
    return json;
}

} // namespace

std::string score_json(const Score& score) {
    nlohmann::json rules = nlohmann::json::object();
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        rules[std::string(common_rules()[rule].name)] = {{"found", score.rejected_by(rule)},
                                                         {"of", score.judged_by(rule)}};
    nlohmann::json scenes = nlohmann::json::array();
    for (const Trial& trial : score.unmutated.trials)
        scenes.push_back(trial.scene);
    const nlohmann::json sums{
        {"command", "scripts/mutation_score.sh"},
        {"commit", score.commit},
        {"renderer", score.renderer},
        {"seconds", score.seconds},
        {"scenes", scenes},
        {"frames", trial_frames},
        {"verdict", {{"found", score.killed()}, {"of", score.wanted()}, {"false_alarms", score.false_alarms()}}},
        {"cause", {{"named", score.named()}, {"of", score.hypotheses()}, {"wrongly_named", score.wrongly_named()}}},
        {"other_rules", rules}};
    std::string text = sums.dump(2);
    text.resize(text.size() - 2); // "\n}"
    text += ",\n  \"mutants\": [";
    for (const Outcome& outcome : score.outcomes)
        text += fmt::format("{}\n    {}", &outcome == &score.outcomes.front() ? "" : ",", outcome_json(outcome).dump());
    return text + "\n  ]\n}\n";
}

} // namespace lockstep::test
