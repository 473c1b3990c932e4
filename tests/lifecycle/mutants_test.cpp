#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
using namespace lockstep::test;
namespace lifecycle = lockstep::lifecycle;

namespace {

/// A change of a shader's text.
struct Mutant {
    std::string name, file, text, replacement, run;
    int times = 1;
    std::string cause;      ///< as a report names it; empty: no one change of the twin is the same
    std::string equivalent; ///< why it is as right as the original in its run; empty: it is to be found
};

std::vector<Mutant> catalogue() {
    std::ifstream stream("tests/lifecycle/mutants.json");
    std::vector<Mutant> all;
    for (const nlohmann::json& one : nlohmann::json::parse(stream))
        all.push_back({one.at("name"), one.at("file"), one.at("text"), one.at("replacement"), one.value("run", "plain"),
                       one.value("times", 1), one.value("cause", ""), one.value("equivalent", "")});
    return all;
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

/// The mutant's shaders in a folder of their own.
void plant(const Mutant& mutant, const TemporaryFolder& folder) {
    for (const auto& entry : std::filesystem::directory_iterator("shaders/lifecycle")) {
        std::string text = read(entry.path());
        if (entry.path().filename() == mutant.file)
            for (std::size_t at = text.find(mutant.text); at != std::string::npos;
                 at = text.find(mutant.text, at + mutant.replacement.size()))
                text.replace(at, mutant.text.size(), mutant.replacement);
        std::ofstream(folder.path() / entry.path().filename()) << text;
    }
}

/// Small systems in which what a mutant changes has something to do.
lifecycle::Settings settings_of(const std::string& run) {
    using Kind = lifecycle::Force::Kind;
    lifecycle::Settings s;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 2500;
    e.rate = 1800.0;
    e.lifetime = {0.1F, 0.3F};
    e.shape = lifecycle::Emitter::Shape::box;
    e.min = {-1.0F, 0.2F, -1.0F};
    e.max = {1.0F, 0.5F, 1.5F};
    e.direction = {0.3F, 1.0F, 0.2F};
    e.direction_jitter = 0.5F;
    e.speed_jitter = 0.25F;
    e.acceleration = {0.5F, -9.8F, 0.25F};
    e.size = {0.1F, 0.03F};
    e.color = {glm::vec4(0.6F, 0.81F, 1.0F, 0.9F), glm::vec4(0.2F, 0.4F, 0.77F, 0.1F)};
    s.switches.time_code = lifecycle::TimeCode::half_seconds;
    if (run == "ticks")
        s.switches.time_code = lifecycle::TimeCode::ticks16;
    if (run == "towards")
        s.switches.half_rounding = lifecycle::HalfRounding::toward_zero;
    if (run == "full")
        e.capacity = 300;
    if (run == "crowd")
        e.rate = 60000.0, e.capacity = 20000, s.switches.may_die = lifecycle::MayDie::all;
    if (run == "kill")
        e.forces = {{.kind = Kind::attraction, .centre = {0.0F, 0.4F, 0.0F}, .kill_radius = 0.5F}};
    if (run == "forces") {
        s.switches.layout = lifecycle::Layout::bytes_112;
        s.switches.fuse = lifecycle::Fuse::split;
        s.switches.emit_when = lifecycle::EmitWhen::before_destroy;
        e.forces = {{.kind = Kind::drag, .k = 0.8F},
                    {.kind = Kind::vortex,
                     .centre = {0.2F, 0.0F, 0.1F},
                     .axis = {0.2F, 1.0F, 0.1F},
                     .strength = 20.0F,
                     .radius = 2.0F,
                     .falloff = 2,
                     .pull = 5.0F},
                    {.kind = Kind::attraction, .centre = {0.0F, 2.0F, 0.0F}, .strength = 5.0F, .inverse_square = true},
                    {.kind = Kind::curl_noise, .strength = 9.0F, .frequency = 1.7F, .pan = {0, -0.5F, 0}}};
    }
    if (run == "ribbon") {
        e.shape = lifecycle::Emitter::Shape::point;
        e.rate = 2000.0;
        e.capacity = 900;
        e.speed = 0.05F;
        e.path = {{0, {-2, 0, 0}}, {15, {2, 1, 0}}, {25, {2, 1, 0}}, {40, {-2, 0, 1}}};
        e.draw = lifecycle::Emitter::Draw::ribbon;
        e.uv_scale = 0.75F;
        s.camera.eye = {0.0F, 1.0F, 8.0F};
        s.switches.layout = lifecycle::Layout::bytes_112;
    }
    return s;
}

struct Outcome {
    std::string verdict = "AGREE";
    std::vector<std::string> causes; ///< that explain everything, the likeliest first

    [[nodiscard]] bool found() const { return verdict != "AGREE" && verdict != "LEGAL"; }
};

Outcome run_of(const std::string& shaders, const std::string& run) {
    Outcome outcome;
    try {
        const CheckReport report = run_lifecycle(settings_of(run), 26, CheckMode::resync, shaders);
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

Outcome run_of(const Mutant& mutant) {
    const TemporaryFolder folder;
    plant(mutant, folder);
    return run_of(folder.path().string(), mutant.run);
}

bool is_named(const Mutant& mutant, const Outcome& outcome) {
    return std::find(outcome.causes.begin(), outcome.causes.end(), mutant.cause) != outcome.causes.end();
}

} // namespace

TEST_CASE("lifecycle mutants: each text stands in the shipped shader as often as the catalogue says") {
    std::set<std::string> names;
    for (const Mutant& mutant : catalogue()) {
        INFO(mutant.name);
        CHECK(occurrences(read("shaders/lifecycle/" + mutant.file), mutant.text) == mutant.times);
        CHECK(names.insert(mutant.name).second);
    }
    CHECK(names.size() >= 60);
}

TEST_CASE("lifecycle mutants: some are found and named, and the shipped shaders are not") {
    if (!gl())
        return skip(gl().missing());
    for (const char* const run : {"plain", "forces", "ribbon"})
        CHECK(run_of("shaders/lifecycle", run).verdict == "AGREE");
    const std::set<std::string> few{"acceleration_reversed", "born_backwards", "rank_inclusive", "ring_not_filled",
                                    "vortex_reversed"};
    std::size_t run = 0;
    for (const Mutant& mutant : catalogue()) {
        if (!few.contains(mutant.name))
            continue;
        ++run;
        const Outcome outcome = run_of(mutant);
        INFO(mutant.name << ": " << outcome.verdict);
        CHECK(outcome.found());
        CHECK((mutant.cause.empty() || is_named(mutant, outcome)));
    }
    CHECK(run == few.size());
}

/// All of them, as a table: lockstep_tests_lifecycle "[mutants]"
TEST_CASE("lifecycle mutants: the whole catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    std::size_t wanted = 0, found = 0, to_name = 0, named = 0, false_alarms = 0;
    const char* only = std::getenv("LOCKSTEP_LIFECYCLE_MUTANT");
    for (const Mutant& mutant : catalogue()) {
        if (only != nullptr && mutant.name.find(only) == std::string::npos)
            continue;
        const Outcome outcome = run_of(mutant);
        const bool is_wanted = mutant.equivalent.empty();
        wanted += is_wanted ? 1 : 0;
        found += is_wanted && outcome.found() ? 1 : 0;
        false_alarms += !is_wanted && outcome.found() ? 1 : 0;
        to_name += is_wanted && !mutant.cause.empty() ? 1 : 0;
        named += is_wanted && !mutant.cause.empty() && is_named(mutant, outcome) ? 1 : 0;
        std::cout << fmt::format("{:32} {:9} {}{}\n", mutant.name, outcome.verdict.substr(0, 90),
                                 fmt::join(outcome.causes, " | "),
                                 mutant.cause.empty() || is_named(mutant, outcome) ? "" : "   WANTED " + mutant.cause)
                  << std::flush;
        CHECK((outcome.found() || !is_wanted));
    }
    std::cout << fmt::format("{} of {} found, {} of {} named, {} false alarms\n", found, wanted, named, to_name,
                             false_alarms);
}
