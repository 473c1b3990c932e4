#include "crosscheck/cli/thesis_study.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/study_parts.hpp"
#include "crosscheck/collision/study/thesis_report.hpp"
#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// What is measured, and where it goes.
struct ThesisStudy {
    RunOptions run;
    std::filesystem::path scenes;
    std::filesystem::path csv, json, chart; ///< empty: not wanted
    std::filesystem::path from;             ///< a file --json wrote: told and drawn again instead of measured
    std::vector<std::size_t> counts{50'000, 100'000, 150'000, 200'000};
    double seconds = 5.0;
};

ThesisRun measure(const ThesisStudy& study) {
    const Context context(parse_context_request(study.run.gl));
    ThesisOptions options;
    options.scenes = scenes_or_shipped(study.scenes);
    options.shaders = study.run.shaders;
    options.preset = study.run.preset;
    options.set = study.run.set;
    options.counts = study.counts;
    options.frames = study.run.frames;
    options.seconds = study.seconds;
    options.compute = context.describe().compute;
    options.on_left_out = [](std::string_view what, std::string_view reason) {
        fmt::print("left out: {}, since {}\n", what, reason);
    };
    options.on_cell = [first = true](const ThesisCell& cell) mutable {
        fmt::print("{}{}", std::exchange(first, false) ? thesis_cell_head() : "", thesis_cell_text(cell));
        std::fflush(stdout);
    };
    if (!options.compute)
        fmt::print("no octree and no depth: both need compute shaders, GL 4.3; this context is {}\n",
                   context.describe().version);
    ThesisRun run{summary(context.describe()), thesis_study(options)};
    fmt::print("\n");
    return run;
}

void run_thesis_study(const ThesisStudy& study) {
    if (!study.chart.empty() && !have_gnuplot())
        throw Error(fmt::format("study: --chart: {}", no_gnuplot));
    OutputFiles files;
    protect_inputs(study.run, files);
    files.protect(study.from);
    for (const auto& file : {study.csv, study.json, study.chart})
        if (!file.empty())
            files.expect(file);
    const ThesisRun run = study.from.empty() ? measure(study) : read_thesis_json(study.from);
    fmt::print("{}", thesis_text(run));
    if (!study.csv.empty())
        files.write(study.csv, thesis_csv(run));
    if (!study.json.empty())
        files.write(study.json, json_text(thesis_json(run)));
    if (!study.chart.empty())
        files.write(study.chart, run_gnuplot(thesis_chart(run)));
    files.commit();
}

} // namespace

Verb thesis_verb() {
    auto options = std::make_shared<ThesisStudy>();
    Verb verb{"thesis",
              "the thesis's tables 4-1 and 5-1 and figures 5-3 and 5-5, CDT, octree and the scene's depth, on GL"};
    add_settings_options(verb, options->run);
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames, "frames to measure"));
    verb.add(integers_option("--counts", "N,...", {1, most_particles}, options->counts, "particle counts"));
    verb.add(
        seconds_option("--seconds", options->seconds, "a measurement ends with the frame in which this time is over"));
    verb.add(path_option("--csv", "FILE", options->csv, "write every number of every cell"));
    verb.add(path_option("--json", "FILE", options->json, "the same as JSON"));
    verb.add(path_option("--chart", "FILE", options->chart, "draw the times over the counts as SVG, by gnuplot"));
    verb.add(path_option("--from", "FILE", options->from,
                         "report and draw what an earlier --json wrote, on a machine without that GL"));
    add_gl_options(verb, options->run);
    add_scenes_option(verb, options->scenes);
    verb.footer = "Example: lockstep study thesis --gl egl-device:0 --json thesis.json --chart thesis.svg";
    verb.run = [options](const Call& call) {
        for (const std::string& name : call.given)
            if (!options->from.empty() && name != "--from" && name != "--json" && name != "--csv" && name != "--chart")
                throw Error(fmt::format("study thesis: {} does not go with --from, which measures nothing", name));
        start_threads(options->run.threads);
        run_thesis_study(*options);
        return status_agree;
    };
    return verb;
}

} // namespace lockstep
