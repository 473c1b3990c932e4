/// Runs the catalogue of mutants and tells what finds them: lockstep_mutants [--pass PASS] [--json FILE] [--markdown
/// FILE].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <omp.h>

#include "crosscheck/cli/command_line.hpp"
#include "crosscheck/cli/option_values.hpp"
#include "crosscheck/files/atomic_file.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"
#include "tests/mutants/score.hpp"

using namespace lockstep;
using namespace lockstep::test;

namespace {

int run(const std::vector<std::string>& only, const std::string& gl, const std::filesystem::path& json,
        const std::filesystem::path& markdown, const std::string& commit, const std::string& pass) {
    omp_set_num_threads(1); // the scenes are too small to share
    const Context context(parse_context_request(gl));
    const auto start = std::chrono::steady_clock::now();
    Score score;
    score.renderer = summary(context.describe());
    score.commit = commit;
    const Profile profile = measured_profile(context);
    std::vector<Mutant> catalogue = on_driver(whole_catalogue(), profile);
    if (!pass.empty())
        std::erase_if(catalogue, [&](const Mutant& m) { return m.pass != pass; });
    if (catalogue.empty())
        throw Error(fmt::format("no mutant is of pass {}", pass));
    for (const std::string& name : only)
        if (std::none_of(catalogue.begin(), catalogue.end(), [&](const Mutant& m) { return m.name == name; }))
            throw Error(fmt::format("no mutant is named {}", name));
    std::vector<TrialScene> scenes = trial_scenes(profile);
    std::erase_if(scenes, [&](const TrialScene& scene) { return !pass.empty() && scene.pass() != pass; });
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
    std::vector<std::string> only;
    std::string gl = "osmesa";
    std::filesystem::path json, markdown;
    std::string commit, pass;
    Verb program{"lockstep_mutants", "Runs the catalogue of mutants, from the root of the source tree"};
    program.add(texts_option("name", "MUTANT", only, "only these mutants"));
    program.add(text_option("--pass", "PASS", pass, "only those of octree_pass, say"));
    program.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", gl, "which GL to open"));
    program.add(path_option("--json", "FILE", json, "results as data"));
    program.add(path_option("--markdown", "FILE", markdown, "results as a table"));
    program.add(text_option("--commit", "COMMIT", commit, "kept in the results"));
    program.run = [&](const Call&) { return run(only, gl, json, markdown, commit, pass); };
    try {
        return run_command_line(program, argc, argv, 2);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep_mutants: {}\n", error.what());
        return 2;
    }
}
