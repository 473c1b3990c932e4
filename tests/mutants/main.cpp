/// Runs the catalogue of mutants and tells what finds them: lockstep_mutants [--pass PASS] [--json FILE] [--markdown
/// FILE] [--shard K/N] [--jobs N].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crosscheck/command/command_line.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/command/shard.hpp"
#include "crosscheck/files/atomic_file.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"
#include "tests/mutants/outcome_json.hpp"
#include "tests/mutants/score.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
using namespace lockstep::test;

namespace {

/// Which mutants are run.
struct Selection {
    std::vector<std::string> only;
    std::string pass;
    Shard shard;
    Shard job; ///< of those in the shard
};

std::vector<Mutant> selected(std::vector<Mutant> catalogue, const Selection& of) {
    if (!of.pass.empty())
        std::erase_if(catalogue, [&](const Mutant& m) { return m.pass != of.pass; });
    if (catalogue.empty())
        throw Error(fmt::format("no mutant is of pass {}", of.pass));
    for (const std::string& name : of.only)
        if (std::none_of(catalogue.begin(), catalogue.end(), [&](const Mutant& m) { return m.name == name; }))
            throw Error(fmt::format("no mutant is named {}", name));
    std::vector<Mutant> some;
    std::size_t index = 0;
    for (Mutant& mutant : catalogue) {
        if (!of.only.empty() && std::find(of.only.begin(), of.only.end(), mutant.name) == of.only.end())
            continue;
        const std::size_t at = index++;
        if (of.shard.has(at) && of.job.has(at / of.shard.of))
            some.push_back(std::move(mutant));
    }
    if (of.shard.is_asked() && of.shard.part > index)
        throw Error(
            fmt::format("{}: {} mutants make {} parts at most, and none may be empty", of.shard.asked, index, index));
    return some;
}

Score run_selection(const std::string& gl, const Selection& of) {
    const Context context(parse_context_request(gl));
    Score score;
    score.renderer = summary(context.describe());
    const Profile profile = measured_profile(context);
    const std::vector<Mutant> mutants = selected(on_driver(whole_catalogue(), profile), of);
    std::vector<TrialScene> scenes = trial_scenes(profile);
    std::erase_if(scenes, [&](const TrialScene& scene) { return !of.pass.empty() && scene.pass() != of.pass; });
    score.unmutated = run_mutant({}, scenes);
    for (const Mutant& mutant : mutants) {
        score.outcomes.push_back(run_mutant(mutant, scenes));
        fmt::print("{}\n", outcome_line(score.outcomes.back()));
        std::fflush(stdout);
    }
    return score;
}

/// A process that runs part of the mutants and leaves its score in a file.
pid_t start_job(const std::string& gl, const Selection& of, const std::filesystem::path& file) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child != 0)
        return child;
    int status = 0;
    try {
        write_text_file(file, whole_json(run_selection(gl, of)).dump());
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep_mutants: {}\n", error.what());
        status = 2;
    }
    std::fflush(stdout);
    _exit(status);
}

/// The same by `jobs` processes, since GL wants one a context.
Score run_jobs(const std::string& gl, const Selection& of, std::size_t jobs) {
    const std::vector<Mutant> all = selected(whole_catalogue(), of);
    std::map<std::string, Mutant> catalogue;
    for (const Mutant& mutant : all)
        catalogue[mutant.name] = mutant;
    const TemporaryFolder folder;
    const auto file = [&](std::size_t job) { return folder.path() / fmt::format("{}.json", job); };
    std::vector<pid_t> children;
    for (std::size_t job = 1; job <= jobs; ++job) {
        Selection part = of;
        part.job = {job, jobs, {}};
        children.push_back(start_job(gl, part, file(job)));
    }
    bool well = true;
    for (const pid_t child : children) {
        int status = 0;
        well = child > 0 && waitpid(child, &status, 0) == child && status == 0 && well;
    }
    if (!well)
        throw Error("a part of the mutants could not be run");
    Score score;
    for (std::size_t job = 1; job <= jobs; ++job) {
        Score part = read_score(nlohmann::json::parse(std::ifstream(file(job))), catalogue);
        score.renderer = part.renderer;
        if (job == 1)
            score.unmutated = std::move(part.unmutated);
        std::move(part.outcomes.begin(), part.outcomes.end(), std::back_inserter(score.outcomes));
    }
    const auto place = [&](const Outcome& outcome) {
        return std::find_if(all.begin(), all.end(), [&](const Mutant& m) { return m.name == outcome.mutant.name; });
    };
    std::sort(score.outcomes.begin(), score.outcomes.end(),
              [&](const Outcome& a, const Outcome& b) { return place(a) < place(b); });
    return score;
}

int run(const std::string& gl, const Selection& of, std::size_t jobs, const std::filesystem::path& json,
        const std::filesystem::path& markdown, const std::string& commit) {
    omp_set_num_threads(1); // the scenes are too small to share
    const auto start = std::chrono::steady_clock::now();
    Score score = jobs == 1 ? run_selection(gl, of) : run_jobs(gl, of, jobs);
    score.commit = commit;
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
    Selection of;
    std::string gl = "osmesa";
    std::filesystem::path json, markdown;
    std::string commit;
    std::size_t jobs = 1;
    Verb program{"lockstep_mutants", "Runs the catalogue of mutants, from the root of the source tree"};
    program.add(texts_option("name", "MUTANT", of.only, "only these mutants"));
    program.add(text_option("--pass", "PASS", of.pass, "only those of octree_pass, say"));
    program.add(shard_option(of.shard));
    program.add(integer_option("--jobs", "N", {1, 256}, jobs, "processes that share them"));
    program.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", gl, "which GL to open"));
    program.add(path_option("--json", "FILE", json, "results as data"));
    program.add(path_option("--markdown", "FILE", markdown, "results as a table"));
    program.add(text_option("--commit", "COMMIT", commit, "kept in the results"));
    program.run = [&](const Call&) {
        if (!of.shard.is_asked())
            of.shard = shard_of_environment();
        return run(gl, of, jobs, json, markdown, commit);
    };
    try {
        return run_command_line(program, argc, argv, 2);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep_mutants: {}\n", error.what());
        return 2;
    }
}
