#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/systems.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"
#include "crosscheck/package/item_verbs.hpp"

namespace lockstep {

/// What `lockstep check` is asked of a scene of a registered system.
struct SystemCheck {
    CheckMode mode = CheckMode::resync;
    Legal legal = Legal::by_text;
    PassRules rules;
    std::filesystem::path json, hashes, images, report;
    bool power = false; ///< list the mistakes that would have shown
    bool quiet = false;
    bool hexadecimal = false;
    bool render = true;               ///< what the last frame draws is judged, too; of a recording it is not
    std::filesystem::path trace = {}; ///< the recording; empty: a scene that runs here
    bool frames_given = false;        ///< else all that were recorded
};

/// What `lockstep render` is asked of one.
struct SystemRender {
    int frame = 0;
    bool gpu = false;
    std::string profile = "strict"; ///< of the reference
    std::filesystem::path output;
};

/// What `lockstep bench` is asked of one.
struct SystemBench {
    std::vector<std::size_t> counts;
    int warm_up = 0;
    Legal legal = Legal::by_text;
    PassRules rules;
    bool gl_only = false; ///< neither reference nor check
    bool floor = false;   ///< SystemScene::floor, too
};

/// The options of `lockstep check` that such a scene has.
std::span<const std::string_view> system_check_options();

// The verbs for a scene of a registered system. Each returns the exit status, or throws Error.
int check_system(const RegisteredSystem& system, const RunOptions& run, const SystemCheck& asked);
// `trace`: a recording instead of run.scene; may be empty.
int explain_system(const RegisteredSystem& system, const RunOptions& run, const SystemItem& item,
                   const std::filesystem::path& trace);
/// `setup`: all but what starts the run.
int debug_system(const RegisteredSystem& system, const RunOptions& run, Legal legal, DebugSetup setup,
                 const std::filesystem::path& trace);
int record_system(const RegisteredSystem& system, const RunOptions& run, const std::filesystem::path& output,
                  int deflate);
int tell_recording(const RegisteredSystem& system, const std::filesystem::path& file);
int hash_system(const RegisteredSystem& system, const RunOptions& run, const std::string& profile,
                const HashedFrames& frames);
int hash_system_on_gpu(const RegisteredSystem& system, const RunOptions& run, const HashedFrames& frames);
int bench_system(const RegisteredSystem& system, const RunOptions& run, const SystemBench& asked);
int render_system(const RegisteredSystem& system, const RunOptions& run, const SystemRender& asked);
int cut_system(const RegisteredSystem& system, const RunOptions& run, const SystemItem& item,
               const std::filesystem::path& trace, const std::filesystem::path& output);

/// The registered system that a recording is of; null where it is a trace of the default one's. Throws Error where it
/// is of none.
const RegisteredSystem* system_of_recording(const std::filesystem::path& file);

/// Shows a capsule that cut_system wrote; nothing if `file` is no such capsule.
std::optional<int> show_system(const std::filesystem::path& file, bool hexadecimal);

} // namespace lockstep
