#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/legal.hpp"
#include "crosscheck/judge/power_summary.hpp"
#include "crosscheck/judge/render_verdict.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/schema.hpp"

namespace lockstep {

enum class CheckMode {
    resync, ///< after each frame the reference restarts from the GPU's state, so each step is judged alone
    free    ///< both sides run on by themselves, and the growth of the difference is shown
};

enum class Verdict {
    agree,            ///< every bit
    legal,            ///< what differs is rounding or a tie (verdict.hpp)
    undefined,        ///< something rests on what GL leaves open, nothing is divergent
    divergent,        ///< no legal run explains something
    differ,           ///< free mode, search = octree or remedies, where differences are not judged
    nondeterministic, ///< the GPU gave two answers to one frame
};

/// A difference and the frame it belongs to.
struct FrameDifference {
    int frame = 0;
    Difference difference;
};

/// How much differed in one frame; kept for every frame with a difference, and in free mode for every frame.
struct FrameCount {
    int frame = 0;
    std::vector<std::uint64_t> items; ///< of each buffer and image, in the schema's order
    std::int64_t worst_ulp = 0;
};

/// Seconds a frame took, by what was done.
struct FrameTimes {
    double gpu = 0.0;      ///< the GL frame alone, to glFinish
    double readback = 0.0; ///< particles and CDT to this side
    double reference = 0.0;
    double compare = 0.0;
    double judge = 0.0; ///< verdicts and causes
    double power = 0.0; ///< trying which mistakes would have shown
};

/// Of CheckReport::untried.
inline constexpr std::string_view no_hits = "nothing collided";

struct CheckReport {
    Schema schema; ///< what was compared
    Verdict verdict = Verdict::agree;
    int first = 0;        ///< the first frame that was to be compared; those before only led there
    int frames = 0;       ///< frames compared
    int frames_asked = 0; ///< more than `frames`: the run was stopped
    std::string ended_by; ///< why a run that had diverged could not go on; empty: it could
    std::size_t particles = 0;
    Comparison total;
    std::optional<int> first_frame;     ///< the first frame with a difference, or that did not repeat itself
    std::vector<FrameDifference> worst; ///< of the first differing frame, largest ULP first
    std::vector<FrameCount> counts;
    PowerSummary power; ///< resync mode
    /// What diverges is legal by this rule, as far as was tried: the shader may be right and round otherwise.
    std::optional<Legal> wider_rule = {};
    std::optional<VerdictSummary> verdicts; ///< resync mode, search = cdt, no remedies
    bool counts_hits = false;               ///< whether the next two are known
    bool expects_texels = false;            ///< a run in which none is drawn tried little
    std::uint64_t hits = 0;                 ///< particle-frames in which the reference found a collision
    std::uint64_t drawn_texels = 0;         ///< texels written by the reference, summed over frames
    std::uint64_t reference_hash = 0;
    std::uint64_t gpu_hash = 0;            ///< state_hash of particles and CDT after the last frame
    std::vector<FrameTimes> times;         ///< one a frame
    std::optional<RenderVerdict> rendered; ///< not set: the rendered frame was not compared
    std::optional<Verdict> state_verdict;  ///< set: on all but what a frame draws, which made the verdict worse
    /// What such a run was to try and did not, as words after "but": "nothing collided".
    std::vector<std::string> untried;
    /// What was asked of the run (PassRules) and does not hold, whatever its verdict.
    std::vector<std::string> failures;
    /// A shader's text does what GLSL gives no result for, and such are not allowed (--werror-shaders).
    bool fails_by_text = false;
    /// Which part of a run this is, and what asked for that; empty: the whole run.
    std::string part;
    double covered = 1.0; ///< the share of the shaders' texts that was covered, where that was asked for
    std::vector<std::string> without_effect; ///< passes that left what was there, in all frames

    /// The run was stopped before its end; a verdict on the frames before that.
    [[nodiscard]] bool partial() const { return frames < frames_asked && verdict != Verdict::nondeterministic; }
    /// By Ctrl-C.
    [[nodiscard]] bool interrupted() const { return partial() && ended_by.empty(); }
};

/// What passes besides agree and legal, and what does not although they do.
struct PassRules {
    bool allow_undefined = false;
    bool require_hits = false;   ///< a run in which nothing collided fails
    double power_at_least = 0.0; ///< one that would have shown a smaller share of the mistakes with names, too
    double cover_at_least = 0.0; ///< one that covered a smaller share of the user's own shaders' texts
};

[[nodiscard]] inline bool passes(const CheckReport& report, const PassRules& rules = {}) {
    const bool fits = report.verdict == Verdict::agree || report.verdict == Verdict::legal ||
                      (report.verdict == Verdict::undefined && rules.allow_undefined);
    return fits && !report.partial() && !report.fails_by_text && !(rules.require_hits && report.hits == 0) &&
           report.power.share() >= rules.power_at_least && report.covered >= rules.cover_at_least;
}

/// Counts what a comparison of a frame found; there may be several of a frame.
void note_difference(CheckReport& report, int frame, const Comparison& comparison);

/// Numbers the one frame of a run that began with frame 0 as another.
void number_frame(CheckReport& report, int frame);

/// What the counts of a run come to.
[[nodiscard]] Verdict verdict_on(const CheckReport& report);

/// A run that would have shown a smaller share of the known mistakes fails. Throws Error in free mode, which judges no
/// step.
void ask_power(CheckReport& report, double at_least);

struct CoverageCount;

/// A run that covered a smaller share of the shaders' texts fails. Throws Error where none was run.
void ask_coverage(CheckReport& report, const CoverageCount& covered, double at_least);

/// Where hits are required, a run in which nothing collided fails.
void ask_hits(CheckReport& report, const PassRules& rules);

/// Takes up the verdict on a rendered frame of the run: the run's is the worse of both.
void add_rendered(CheckReport& report, RenderVerdict rendered);

struct CheckOptions {
    CheckMode mode = CheckMode::resync;
    int first = 0;              ///< in resync mode later ones, too: those before are run, and not compared
    int frames = 60;            ///< the frame after the last
    std::vector<int> only = {}; ///< of these frames some alone, ascending; empty: all
    int repeated_frames = 2;    ///< the first frames run twice on the GPU and must repeat themselves bit by bit
    std::function<void(int frames_done)> on_frame;
    /// What legal outcomes are taken from; not set: what the profile's driver was measured to do.
    std::optional<KnownOperations> known;
    bool causes = true;                      ///< look for the mistake behind what diverges
    bool power = true;                       ///< try which mistakes would have shown
    const std::atomic<bool>* stop = nullptr; ///< set: end after the frame at hand, with the verdict so far
};

} // namespace lockstep
