#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/part_file.hpp"
#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/judge/joined_parts.hpp"
#include "crosscheck/report/junit.hpp"
#include "crosscheck/report/report.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct MergeRequest {
    std::vector<std::string> parts;
    std::filesystem::path trace; ///< where the recording lies now; empty: where it lay
    std::filesystem::path json, junit;
    bool power = false, quiet = false;
    int threads = 0;
};

std::string judged_text(const CheckRequest& request) {
    const std::string text = legal_option_text(request.legal) + pass_options_text(request.rules);
    return text.empty() ? "without options of its own" : "with" + text;
}

/// Throws Error unless both are parts of one run.
void expect_of_one_run(const RunPart& one, const RunPart& other) {
    const auto fail = [&](const std::string& what) {
        throw Error(fmt::format("{}: not of the same run as {}: {}", other.file, one.file, what));
    };
    if (one.recording.sha256 != other.recording.sha256 || one.recording.bytes != other.recording.bytes ||
        one.recorded != other.recorded)
        fail(fmt::format("recording {}..., there {}...", other.recording.sha256.substr(0, 12),
                         one.recording.sha256.substr(0, 12)));
    if (one.of != other.of)
        fail(fmt::format("{} frames are shared out, there {}", other.of, one.of));
    if (judged_text(one.request) != judged_text(other.request))
        fail(fmt::format("judged {}, there {}", judged_text(other.request), judged_text(one.request)));
    const auto told = [](const CheckedRun& run) {
        return std::tie(run.name, run.context, run.profile, run.settings, run.notes, run.recorded_shaders, run.width);
    };
    if (told(one.run) != told(other.run))
        fail("it is of another scene, driver, profile or shader");
}

std::string frames_text(int first, int end) {
    return end - first == 1 ? fmt::format("frame {}", first) : fmt::format("frames {} to {}", first, end - 1);
}

/// Throws Error unless every frame is in one part and no more.
void expect_all_frames(const std::vector<RunPart>& parts) {
    int next = 0;
    const auto expect = [&](int first) {
        if (first > next)
            throw Error(fmt::format("{} of {}, of {}: in no part; right are all parts of the run, each once",
                                    frames_text(next, first), parts.front().of, parts.front().request.trace.string()));
    };
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const CheckReport& report = parts[p].report;
        expect(report.first);
        if (report.first < next)
            throw Error(fmt::format("{}: {} are in {}, too; right are all parts of the run, each once", parts[p].file,
                                    frames_text(report.first, std::min(next, report.first + report.frames)),
                                    parts[p - 1].file));
        next = report.first + report.frames;
    }
    expect(parts.front().of);
}

std::vector<RunPart> parts_of_run(const std::vector<PartFile>& files) {
    std::vector<RunPart> parts;
    for (const PartFile& file : files) {
        parts.push_back(*file.run);
        expect_of_one_run(parts.front(), parts.back());
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const RunPart& a, const RunPart& b) { return a.report.first < b.report.first; });
    expect_all_frames(parts);
    return parts;
}

/// What was another in one of two parts; empty: nothing.
std::string stress_difference(const StressReport& one, const StressReport& other) {
    if (one.asked != other.asked)
        return fmt::format("{}, there {}", plain_line(one.asked), plain_line(other.asked));
    if (const std::string input = input_difference(one.inputs, other.inputs); !input.empty())
        return input;
    if (one.profile != other.profile)
        return "the driver was measured to compute otherwise (lockstep probe)";
    return one.of != other.of ? fmt::format("{} scenes, there {}", one.of, other.of) : std::string();
}

/// The stress scenes of all parts, each once.
StressReport join_stress(const std::vector<PartFile>& files) {
    StressReport all = *files.front().stress;
    all.scenes.clear();
    std::vector<const PartFile*> from(all.of, nullptr);
    for (const PartFile& part : files) {
        if (const std::string other = stress_difference(*part.stress, all); !other.empty())
            throw Error(fmt::format("{}: not of the same run as {}: {}", part.file, files.front().file, other));
        for (const StressScene& scene : part.stress->scenes) {
            if (from[scene.index] != nullptr)
                throw Error(fmt::format("{}: scene {} is in {}, too; right are all parts of the run, each once",
                                        part.file, scene.name, from[scene.index]->file));
            from[scene.index] = &part;
            all.scenes.push_back(scene);
        }
    }
    const auto missing = std::find(from.begin(), from.end(), nullptr);
    if (missing != from.end())
        throw Error(fmt::format("scene {} of {}: in no part; right are all parts of the run, each once",
                                missing - from.begin() + 1, all.of));
    std::sort(all.scenes.begin(), all.scenes.end(),
              [](const StressScene& a, const StressScene& b) { return a.index < b.index; });
    return all;
}

int merge_stress(const MergeRequest& asked, OutputFiles& files, const std::vector<PartFile>& parts) {
    if (!asked.junit.empty() || !asked.trace.empty())
        throw Error(fmt::format("merge: {} goes with parts of a recording, not of check --stress",
                                asked.junit.empty() ? "--trace" : "--junit"));
    const StressReport report = join_stress(parts);
    if (!asked.quiet) {
        fmt::print("{}", stress_head());
        bool failed = false;
        for (const StressScene& scene : report.scenes) {
            fmt::print("{}", stress_line(scene, !scene.passes && !failed));
            failed = failed || !scene.passes;
        }
        fmt::print("{}", stress_end(report, asked.power));
    }
    if (!asked.json.empty())
        files.write(asked.json, json_text(stress_json(report)));
    files.commit();
    fmt::print("{}", files.written_text());
    return report.passes() ? status_agree : status_differ;
}

/// What explains all that diverges in several parts follows from all these frames, in their order: they are judged once
/// more.
void find_causes(CheckReport& report, const RunPart& of, const std::filesystem::path& file, int threads) {
    start_threads(threads);
    std::unique_ptr<TraceReader> trace;
    try {
        trace = std::make_unique<TraceReader>(file);
    } catch (const Error& error) {
        throw Error(fmt::format(
            "{}; several parts diverge, and their common cause is looked for in the recording; right is --trace FILE",
            error.what()));
    }
    if (trace->seal().sha256 != of.recording.sha256)
        throw Error(fmt::format("{}: not the recording that the parts are of: {}..., theirs is {}...", file.string(),
                                trace->seal().sha256.substr(0, 12), of.recording.sha256.substr(0, 12)));
    FrameCheckOptions options;
    options.only = report.verdicts->divergent_frames;
    options.frames = options.only.back() + 1;
    options.known = known_operations(trace->info(), of.request.legal);
    options.power = false;
    const Profile profile = followed_profile(trace->info());
    TraceSide side(*trace);
    const CheckReport again = judge_frames(trace->info().scene, profile, side, options);
    report.verdicts->causes = again.verdicts->causes;
    report.wider_rule = again.wider_rule;
}

std::vector<PartFile> read_parts(const std::vector<std::string>& files) {
    std::vector<PartFile> parts;
    for (const std::string& file : files) {
        parts.push_back(read_part_file(file));
        if (parts.back().stress.has_value() != parts.front().stress.has_value())
            throw Error(fmt::format("{}: not of the same run as {}: one is of a recording, the other of check --stress",
                                    file, parts.front().file));
    }
    return parts;
}

int merge(const MergeRequest& asked) {
    const std::vector<PartFile> read = read_parts(asked.parts);
    OutputFiles files;
    for (const PartFile& part : read)
        if (part.run)
            files.protect(part.run->request.trace);
    files.protect(asked.trace);
    for (const std::filesystem::path& file : {asked.json, asked.junit})
        if (!file.empty())
            files.expect(file);
    if (read.front().stress)
        return merge_stress(asked, files, read);
    const std::vector<RunPart> parts = parts_of_run(read);
    CheckReport report = parts.front().report;
    int diverging = 0;
    for (const RunPart& part : parts) {
        diverging += part.report.verdicts->divergent_frames.empty() ? 0 : 1;
        if (&part == &parts.front())
            continue;
        try {
            join(report, part.report);
        } catch (const Error& error) {
            throw Error(fmt::format("{} and {}: {}", parts.front().file, part.file, error.what()));
        }
    }
    report.frames_asked = report.frames;
    CheckRequest request = parts.front().request;
    request.power = asked.power;
    request.quiet = asked.quiet;
    if (diverging > 1)
        find_causes(report, parts.front(), asked.trace.empty() ? request.trace : asked.trace, asked.threads);
    conclude(report);
    ask_power(report, request.rules.power_at_least);
    ask_hits(report, request.rules);
    const RunDescription run = description(request, parts.front().run, report);
    const bool pass = passes(report, request.rules);
    tell(request, report, run);
    if (!asked.json.empty())
        files.write(asked.json, json_text(report_json(report, run)));
    if (!asked.junit.empty())
        files.write(asked.junit, junit_text(report, run, pass));
    files.commit();
    fmt::print("{}", files.written_text());
    return pass ? status_agree : status_differ;
}

} // namespace

Verb merge_command() {
    auto asked = std::make_shared<MergeRequest>();
    Verb verb{"merge", "join the parts of a check, which shards made, into the verdict on the whole run"};
    verb.add(required(texts_option("part", "PART", asked->parts,
                                   "what check --trace FILE --shard K/N --json PART wrote, of every K")));
    verb.add(path_option("--trace", "FILE", asked->trace,
                         "the recording, where it lies elsewhere now; read only if several parts diverge"));
    verb.add(path_option("--json", "FILE", asked->json, "write the report as JSON"));
    verb.add(path_option("--junit", "FILE", asked->junit, "write the verdict as JUnit"));
    verb.add(flag("--power", asked->power, "list which mistakes the run would have shown, and why not the others"));
    verb.add(flag("--quiet", asked->quiet, "no report, only the exit status"));
    verb.add(
        integer_option("--threads", "N", {0, most_threads}, asked->threads, "threads of the reference, 0: one a core"));
    verb.footer =
        "Report and exit status are those of one check of all frames. Parts that are missing, there twice, or of "
        "another run: exit status 2.\n"
        "Example: lockstep merge part_*.json --json whole.json";
    verb.run = [asked](const Call&) { return merge(*asked); };
    return verb;
}

} // namespace lockstep
