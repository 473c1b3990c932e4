#include "crosscheck/report/run_to_run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/report/verdict_text.hpp"

namespace lockstep {

void watch_two_runs(CheckWatch& watch, const System& system, std::vector<TwoRuns>& seen) {
    watch.on_two_runs = [&](std::size_t pass, int frame, const Comparison& two) {
        const std::uint8_t r = system.passes[pass]->resource();
        seen.push_back({std::string(system.passes[pass]->name()), frame, system.schema.resources[r].item,
                        two.differing(r), two.resources[r].extent.count()});
    };
}

std::vector<std::string> run_to_run_notes(const std::vector<TwoRuns>& seen) {
    std::vector<std::string> notes;
    std::vector<std::string> passes;
    for (const TwoRuns& runs : seen) {
        const std::string words =
            fmt::format("frame {} {} of {}", runs.frame, grouped(runs.differing), grouped(runs.items));
        std::size_t at = 0;
        while (at < passes.size() && passes[at] != runs.pass)
            ++at;
        if (at == passes.size()) {
            passes.push_back(runs.pass);
            notes.push_back(fmt::format("run to run, {}: of two runs from one state differ, as GL allows of sums in no "
                                        "fixed order: {} {}s",
                                        runs.pass, words, runs.item));
        } else {
            notes[at] += ", " + words;
        }
    }
    return notes;
}

void to_json(nlohmann::json& json, const TwoRuns& runs) {
    json = {{"pass", runs.pass}, {"frame", runs.frame}, {"differing", runs.differing}, {"items", runs.items}};
}

} // namespace lockstep
