#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/command/verb.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/record/item_capsule.hpp"
#include "crosscheck/record/system_recording.hpp"
#include "crosscheck/report/debug_session.hpp"
#include "crosscheck/report/hash_lines.hpp"
#include "crosscheck/report/page/system_page.hpp"
#include "crosscheck/report/value_text.hpp"

/// What verbs do on any system, of a scene file or of a program of its own.
namespace lockstep {

/// One item of one pass, as typed.
struct SystemItem {
    int frame = 0;
    std::string pass; ///< by name, or by number; empty: the first that runs
    std::string item; ///< its number, or of an image x,y
    Legal legal = Legal::by_text;
    bool hexadecimal = false;
};

Option frame_option(int& frame);
Option pass_option(std::string& pass);
Option hex_option(bool& hexadecimal);

inline NumberFormat number_format(bool hexadecimal) {
    return hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal;
}

/// By their numbers.
struct ItemPlace {
    std::size_t pass = 0, item = 0;
};

/// Throws Error where there is no such pass or item, with those there are.
ItemPlace place_of(const SystemItem& item, const System& system);

/// The lines scene, switches, GL and profile. `file`: the scene's; empty: it has none.
std::string run_heading(const std::string& scene, const std::string& file, const std::string& settings,
                        const std::string& gl, const Profile& profile);

/// The run of both sides to that frame, and what `explain` prints of the item. `file`: the scene's; empty: it has none.
std::string explain_text(const System& system, SystemSide& side, const SystemItem& item, const std::string& file);

/// The same of what a frame's picture draws, a system of its own (SystemPicture) whose only frame is 0.
std::string explain_drawn_text(const System& picture, SystemSide& drawn, const SystemItem& item,
                               const std::string& file);

ItemCapsule cut_item(const System& system, SystemSide& side, const SystemItem& item);

/// What `capsule cut` prints: what was written, the item, and its verdict.
void print_cut(const OutputFiles& files, const System& system, const SystemItem& item, const ItemCapsule& capsule);

/// What `capsule show` prints.
std::string shown_text(const ItemCapsule& capsule, const System& system, NumberFormat format);

/// The exit status: whether the item agrees or is legal.
int status_of(const ItemCapsule& capsule, const System& system);

/// The options of `explain` for a run's first divergence: "--frame", "3", "--pass", "update", ...; none where there is
/// none.
std::vector<std::string> first_item_words(const System& system, const CheckReport& report);

/// Prints the reference's state hash after these frames; it has no lead-in.
void print_hashes(const System& system, const std::string& profile, const HashedFrames& frames);
/// The same of a side that runs alone: nothing is judged, and only what is printed is read. Throws Error where the
/// lead-in names no pass.
void print_gpu_hashes(const System& system, SystemSide& side, const HashedFrames& frames);

/// Records info.frames frames of `side` and says so; its settings, renderer and profile become `info`'s. Gives the exit
/// status.
int record_run(const System& system, SystemSide& side, SystemRunInfo info, const std::filesystem::path& output,
               int deflate);

/// What is in a recording, every value read.
std::string recording_text(const System& system, SystemSide& side, const SystemRecording& recording);

/// check() with what it has done so far on a terminal, until it is done or interrupted.
CheckReport check_shown(const System& system, SystemSide& side, CheckOptions options, bool quiet,
                        const CheckWatch& watch = {});

/// Why `set` changes nothing of a recording.
inline constexpr std::string_view recorded_is_fixed = "what was recorded stays what it is";

/// A session of commands from standard input. Gives the exit status.
int debug_run(DebugSetup setup);

/// The report page and the list of hashes that a check leaves, where they are asked for.
class CheckFiles {
  public:
    /// The folder of report.html, and a file; either may be empty.
    CheckFiles(std::filesystem::path report, std::filesystem::path hashes);

    /// Proves before the run that they can be written. Throws Error where the page is not built.
    void expect(OutputFiles& files);

    /// To be handed to the check. `system` and `side` outlive this.
    CheckWatch watch(const System& system, SystemSide& side, int frames);

    /// What is told of a run on its page besides the report.
    struct Told {
        std::vector<PageCommand> commands;
        SystemPage::ExplainLine explain;
        std::string drawn = {}; ///< of the picture; empty: nothing
        /// The command that shows the capsule beside the page.
        std::function<std::string(const std::filesystem::path& capsule)> show;
    };
    /// `capsule`: cuts the first divergent item, as a file; told as a note of `run` where it cannot.
    void write(OutputFiles& files, const CheckReport& report, RunDescription run, Told told,
               const std::function<std::string()>& capsule);

  private:
    std::filesystem::path report_, hashes_;
    std::string template_, hash_lines_;
    std::optional<SystemPage> page_;
};

} // namespace lockstep
