/// Runs the catalogue of mutants and tells what finds them: lockstep_mutants [--json FILE] [--markdown FILE].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>

#include "crosscheck/files/atomic_file.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"
#include "tests/mutants/score.hpp"

using namespace lockstep;
using namespace lockstep::test;

namespace {

int run(const std::vector<std::string>& only, const std::string& gl, const std::string& json,
        const std::string& markdown, const std::string& commit) {
    omp_set_num_threads(1); // the scenes are too small to share
    const Context context(parse_context_request(gl));
    const auto start = std::chrono::steady_clock::now();
    Score score;
    score.renderer = summary(context.describe());
    score.commit = commit;
    const Profile profile = measured_profile(context);
    const std::vector<Mutant> catalogue = on_driver(whole_catalogue(), profile);
    for (const std::string& name : only)
        if (std::none_of(catalogue.begin(), catalogue.end(), [&](const Mutant& m) { return m.name == name; }))
            throw Error(fmt::format("no mutant is named {}", name));
    std::vector<TrialScene> scenes = trial_scenes(profile);
    score.unmutated = run_mutant({}, scenes);
    for (const Mutant& mutant : catalogue) {
        if (!only.empty() && std::find(only.begin(), only.end(), mutant.name) == only.end())
            continue;
        score.outcomes.push_back(run_mutant(mutant, scenes));
        fmt::print("{}\n", outcome_line(score.outcomes.back()));
        std::fflush(stdout);
    }
    score.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("\n{}", score_text(score));
    if (!json.empty())
        write_text_file(json, score_json(score));
    if (!markdown.empty())
        write_text_file(markdown, score_markdown(score));
    return score.is_full() ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Runs the catalogue of mutants, from the root of the source tree", "lockstep_mutants"};
    std::vector<std::string> only;
    std::string gl = "osmesa";
    std::string json;
    std::string markdown;
    std::string commit;
    app.add_option("name", only, "only these mutants");
    app.add_option("--gl", gl, "auto, osmesa, egl or egl-device:N");
    app.add_option("--json", json, "results as data");
    app.add_option("--markdown", markdown, "results as a table");
    app.add_option("--commit", commit, "kept in the results");
    CLI11_PARSE(app, argc, argv);
    try {
        return run(only, gl, json, markdown, commit);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep_mutants: {}\n", error.what());
        return 2;
    }
}
