#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/command/shard.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/report/report.hpp"

/// What `check` was asked, and what its report on a run says beside the comparison.
namespace lockstep {

struct CheckRequest {
    RunOptions run;
    std::filesystem::path trace; ///< instead of a scene and GL
    FrameRange frames;           ///< to compare
    bool frames_given = false;
    Shard shard;
    bool heeds_environment = false; ///< where no shard is asked for
    CheckMode mode = CheckMode::resync;
    std::filesystem::path json, junit, images, hashes, report;
    Legal legal = Legal::by_text;
    PassRules rules;
    bool no_render = false;
    bool render = false; ///< asked for by name: then one without particles proves too little
    bool stress = false; ///< the stress scenes instead of one
    bool power = false;  ///< list the mistakes that would have shown
    bool quiet = false;
    bool hexadecimal = false;
};

/// The scene of a run and what ran it, as its report has them.
struct CheckedRun {
    std::string name;     ///< the scene's
    std::string file;     ///< the scene's, or the trace's
    std::string context;  ///< renderer, version
    std::string profile;  ///< that the reference follows
    std::string settings; ///< preset and changed switches
    std::vector<std::string> notes;
    std::optional<ShaderUse> shaders; ///< not set: recorded elsewhere
    std::string recorded_shaders;     ///< as told there; empty: not told
    int width = 1;                    ///< of the image
};

/// The command line of the same run over these frames.
std::string repeat_line(const CheckRequest& request, const FrameRange& frames);

/// That of `explain` at "--frame 3 --particle 17".
std::string explain_line(const CheckRequest& request, const std::string& at);

RunDescription description(const CheckRequest& request, const CheckedRun& run, const CheckReport& report);

/// Prints the report unless it is to be quiet.
void tell(const CheckRequest& request, const CheckReport& report, const RunDescription& run);

} // namespace lockstep
