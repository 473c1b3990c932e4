#include "crosscheck/cli/thesis_study.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/study/thesis_report.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

ThesisRun measure(const ThesisStudy& study) {
    const Context context(parse_context_request(study.run.gl));
    ThesisOptions options;
    options.scenes = study.scenes;
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
        fmt::print("no octree and no depth: they need compute shaders, GL 4.3; this context is {}\n",
                   context.describe().version);
    ThesisRun run{summary(context.describe()), thesis_study(options)};
    fmt::print("\n");
    return run;
}

} // namespace

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

} // namespace lockstep
