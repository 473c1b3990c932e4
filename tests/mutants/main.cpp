/// Runs the catalogue of mutants and tells what finds them: lockstep_mutants [--pass PASS] [--json FILE] [--markdown
/// FILE] [--shard K/N].
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

/// "2/8": the second of eight parts. Every eighth mutant is in it, so that slow ones are spread over all.
struct Shard {
    std::size_t part = 1, of = 1;
    [[nodiscard]] bool has(std::size_t index) const { return index % of == part - 1; }
};

Shard parse_shard(const std::string& text) {
    Shard shard;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%zu/%zu%c", &shard.part, &shard.of, &rest) != 2 || shard.part < 1 ||
        shard.part > shard.of)
        throw Error(fmt::format("--shard {}: K/N with K from 1 to N, 2/8 say", text));
    return shard;
}

int run(const std::vector<std::string>& only, const std::string& gl, const std::filesystem::path& json,
        const std::filesystem::path& markdown, const std::string& commit, const std::string& pass, const Shard& shard) {
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
    std::size_t index = 0;
    for (const Mutant& mutant : catalogue) {
        if (!only.empty() && std::find(only.begin(), only.end(), mutant.name) == only.end())
            continue;
        if (!shard.has(index++))
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
    std::string commit, pass, shard = "1/1";
    Verb program{"lockstep_mutants", "Runs the catalogue of mutants, from the root of the source tree"};
    program.add(texts_option("name", "MUTANT", only, "only these mutants"));
    program.add(text_option("--pass", "PASS", pass, "only those of octree_pass, say"));
    program.add(text_option("--shard", "K/N", shard, "only the Kth of N parts"));
    program.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", gl, "which GL to open"));
    program.add(path_option("--json", "FILE", json, "results as data"));
    program.add(path_option("--markdown", "FILE", markdown, "results as a table"));
    program.add(text_option("--commit", "COMMIT", commit, "kept in the results"));
    program.run = [&](const Call&) { return run(only, gl, json, markdown, commit, pass, parse_shard(shard)); };
    try {
        return run_command_line(program, argc, argv, 2);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep_mutants: {}\n", error.what());
        return 2;
    }
}
