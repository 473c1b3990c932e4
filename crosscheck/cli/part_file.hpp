#pragma once
#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/cli/check_request.hpp"
#include "crosscheck/cli/stress_report.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/record/seal.hpp"

namespace lockstep {

/// What `check` leaves of part of a recording, under the key "part" of its JSON, for `merge`.
struct RunPart {
    std::string file; ///< it was read from
    Seal recording;
    int recorded = 0;                        ///< frames in the recording
    int of = 0;                              ///< frames of the whole run
    CheckRequest request;                    ///< trace, legal and rules
    CheckedRun run;                          ///< without what it says of the part alone
    CheckReport report;                      ///< not concluded
    std::vector<std::string> own_notes = {}; ///< what it says of the part alone; not in the file
};

nlohmann::json part_file_json(const RunPart& part);
nlohmann::json stress_part_file_json(const StressReport& report);

/// The text of a report and its part, with a digest of the whole: merge reads only the part, and a change beside it
/// must not go unseen.
std::string part_file_text(nlohmann::json report, nlohmann::json part);

/// A file with part of a run.
struct PartFile {
    std::string file;
    std::optional<RunPart> run;         ///< of a recording
    std::optional<StressReport> stress; ///< else some of the stress scenes
};

/// Throws Error naming the place where the file holds no part, or one of another version, or was changed.
PartFile read_part_file(const std::filesystem::path& file);

} // namespace lockstep
