#include "crosscheck/cli/check_request.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/package/item_verbs.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/power_text.hpp"

namespace lockstep {

std::string repeat_line(const CheckRequest& request, const FrameRange& frames) {
    std::string line =
        request.trace.empty()
            ? command_line("check", request.run, fmt::format("--frames {}", frames.text()))
            : fmt::format("lockstep check --trace {} --frames {}", shell_path(request.trace), frames.text());
    if (request.mode == CheckMode::free)
        line += " --mode free";
    line += legal_option_text(request.legal);
    return line + pass_options_text(request.rules) + (request.no_render ? " --no-render" : "") +
           (request.render ? " --render" : "");
}

std::string explain_line(const CheckRequest& request, const std::string& at) {
    return (request.trace.empty() ? command_line("explain", request.run, at)
                                  : fmt::format("lockstep explain --trace {} {}", shell_path(request.trace), at)) +
           legal_option_text(request.legal);
}

RunDescription description(const CheckRequest& request, const CheckedRun& run, const CheckReport& report) {
    const std::string first = first_arguments(report, run.width);
    return {fmt::format("{} ({})", run.name, plain_line(run.file)),
            run.context,
            run.profile,
            run.settings,
            request.mode == CheckMode::free ? "free" : "resync",
            repeat_line(request, {report.first, frames_to_repeat(report), request.frames.is_part}),
            first.empty() ? first : explain_line(request, first),
            run.notes,
            run.shaders,
            run.recorded_shaders.empty() ? "not in the recording" : "recorded: " + run.recorded_shaders,
            run.shaders ? " (--no-render)" : ": a recording holds no picture",
            true,
            request.trace.empty(),
            number_format(request.hexadecimal)};
}

void tell(const CheckRequest& request, const CheckReport& report, const RunDescription& run) {
    if (request.quiet)
        return;
    if (report.interrupted())
        fmt::print("interrupted after {} of {} frames\n", report.frames, report.frames_asked);
    fmt::print("{}{}", colored(plain_text(report_text(report, run))),
               request.power ? power_text(report.power) : std::string());
    std::fflush(stdout);
}

} // namespace lockstep
