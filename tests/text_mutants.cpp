#include "tests/text_mutants.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test {
namespace {

std::filesystem::path shaders_of(const std::string& system) { return std::filesystem::path("shaders") / system; }

/// Where a mutant's file lies: the system has it, or all systems share it.
std::filesystem::path path_of(const std::string& system, const std::string& file) {
    const std::filesystem::path own = shaders_of(system) / file;
    return std::filesystem::exists(own) ? own : std::filesystem::path("shaders") / file;
}

std::string read(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

int occurrences(const std::string& in, const std::string& text) {
    int count = 0;
    for (std::size_t at = in.find(text); at != std::string::npos; at = in.find(text, at + text.size()))
        ++count;
    return count;
}

Outcome run_of(const std::string& system, const TextMutant& mutant, const RunShaders& run) {
    const TemporaryFolder folder;
    for (const auto& entry : std::filesystem::directory_iterator(shaders_of(system)))
        std::filesystem::copy(entry.path(), folder.path());
    std::string text = read(path_of(system, mutant.file));
    for (std::size_t at = text.find(mutant.text); at != std::string::npos;
         at = text.find(mutant.text, at + mutant.replacement.size()))
        text.replace(at, mutant.text.size(), mutant.replacement);
    std::ofstream(folder.path() / mutant.file) << text;
    return run(folder.path().string(), mutant.run);
}

/// Whether nothing asks for a cause, or it is there.
bool is_named(const TextMutant& mutant, const Outcome& outcome) {
    return mutant.cause.empty() || outcome.names(mutant.cause);
}

} // namespace

std::vector<TextMutant> text_mutants(const std::string& system) {
    std::ifstream stream("tests/" + system + "/mutants.json");
    std::vector<TextMutant> all;
    for (const nlohmann::json& one : nlohmann::json::parse(stream))
        all.push_back({one.at("name"), one.at("file"), one.at("text"), one.at("replacement"), one.value("times", 1),
                       one.value("run", "plain"), one.value("cause", ""), one.value("equivalent", "")});
    return all;
}

bool Outcome::names(const std::string& cause) const {
    return std::find(causes.begin(), causes.end(), cause) != causes.end();
}

Outcome outcome_of(const std::function<CheckReport()>& check) {
    Outcome outcome;
    try {
        const CheckReport report = check();
        outcome.verdict = report.verdict == Verdict::agree       ? "AGREE"
                          : report.verdict == Verdict::legal     ? "LEGAL"
                          : report.verdict == Verdict::divergent ? "DIVERGENT"
                                                                 : "OTHER";
        if (report.verdicts)
            for (const CauseFindings& found : report.verdicts->causes)
                if (found.explains_all())
                    for (const Cause& cause : found.best)
                        outcome.causes.push_back(cause.name());
    } catch (const Error& error) {
        outcome.verdict = std::string("ERROR ") + error.what();
    }
    return outcome;
}

void check_texts(const std::string& system) {
    std::set<std::string> names;
    for (const TextMutant& mutant : text_mutants(system)) {
        INFO(mutant.name);
        CHECK(occurrences(read(path_of(system, mutant.file)), mutant.text) == mutant.times);
        CHECK(names.insert(mutant.name).second);
    }
    CHECK(names.size() >= 60);
}

void check_mutants(const std::string& system, const std::set<std::string>& names, const RunShaders& run) {
    std::size_t there = 0;
    for (const TextMutant& mutant : text_mutants(system)) {
        if (!names.contains(mutant.name))
            continue;
        ++there;
        const Outcome outcome = run_of(system, mutant, run);
        INFO(mutant.name << ": " << outcome.verdict);
        CHECK(outcome.found());
        CHECK(is_named(mutant, outcome));
    }
    CHECK(there == names.size());
}

void check_catalogue(const std::string& system, const RunShaders& run) {
    std::size_t wanted = 0, found = 0, to_name = 0, named = 0, false_alarms = 0;
    const char* only = std::getenv("LOCKSTEP_ONLY_MUTANT");
    for (const TextMutant& mutant : text_mutants(system)) {
        if (only != nullptr && mutant.name.find(only) == std::string::npos)
            continue;
        const Outcome outcome = run_of(system, mutant, run);
        const bool is_wanted = mutant.equivalent.empty(), has_name = is_wanted && !mutant.cause.empty();
        wanted += is_wanted ? 1 : 0;
        found += is_wanted && outcome.found() ? 1 : 0;
        false_alarms += !is_wanted && outcome.found() ? 1 : 0;
        to_name += has_name ? 1 : 0;
        named += has_name && is_named(mutant, outcome) ? 1 : 0;
        std::cout << fmt::format("{:36} {:9} {}{}\n", mutant.name, outcome.verdict.substr(0, 90),
                                 fmt::join(outcome.causes, " | "),
                                 is_named(mutant, outcome) ? "" : "   WANTED " + mutant.cause)
                  << std::flush;
        INFO(mutant.name);
        CHECK(outcome.found() == is_wanted);
    }
    std::cout << fmt::format("{} of {} found, {} of {} named, {} false alarms\n", found, wanted, named, to_name,
                             false_alarms);
}

} // namespace lockstep::test
