#pragma once
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/report/value_text.hpp"
#include "crosscheck/text/text_coverage.hpp"
#include "gpu/shader_use.hpp"

namespace lockstep {

/// What a report says about the run besides the comparison.
struct RunDescription {
    std::string scene;    ///< name and file
    std::string context;  ///< backend, renderer, version
    std::string profile;  ///< the arithmetic the reference followed
    std::string settings; ///< preset and changed switches
    std::string mode;
    std::string repeat;  ///< a command line that repeats a run up to the first difference; {frames} is filled in
    std::string explain; ///< one that shows the first divergence step by step; empty if there is none
    std::vector<std::string> notes = {};   ///< what a reader of the verdict has to know besides
    std::optional<ShaderUse> shaders = {}; ///< whose ran; not set: shaders_untold says why that is not known
    std::string shaders_untold = "an engine's own, of which nothing is known";
    std::string render_hint = {}; ///< how the rendered frame would be compared, where it was not
    bool draws = true;            ///< a picture for people, which can be compared
    bool timed = true;            ///< else without times: of a recording the same check gives the same report
    NumberFormat numbers = NumberFormat::decimal;
    std::vector<TextCoverage> coverage = {}; ///< of the texts of the user's own shaders
};

/// "AGREE", "LEGAL", ...
std::string_view verdict_name(Verdict verdict);

/// The options that set these rules as they are typed, each after a space.
std::string pass_options_text(const PassRules& rules);

/// The verdict with what limits it: "AGREE (partial: stopped after 3 of 60 frames), but nothing collided"; "FAILED:
/// nothing collided, expected a hit; AGREE".
std::string verdict_words(const CheckReport& report);

/// Whose shaders ran, or why that is not known.
std::string shaders_line(const RunDescription& run);

/// The report as a person reads it, verdict last but one, at most 60 lines. See docs/report_lines.md.
std::string report_text(const CheckReport& report, const RunDescription& run);

/// The same as data.
nlohmann::json report_json(const CheckReport& report, const RunDescription& run);

} // namespace lockstep
