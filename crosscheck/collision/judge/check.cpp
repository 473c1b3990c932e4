#include "crosscheck/collision/judge/check.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/absent_particles.hpp"
#include "crosscheck/collision/judge/collision_power.hpp"
#include "crosscheck/collision/judge/diagnosis.hpp"
#include "crosscheck/collision/judge/drawn_cause.hpp"
#include "crosscheck/collision/judge/legal_hint.hpp"
#include "crosscheck/collision/judge/side_state.hpp"
#include "crosscheck/collision/judge/step_cause.hpp"
#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/judge/agreeing_frames.hpp"
#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/power.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/collision/situations.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

/// State of one side after a frame.
struct State {
    Particles particles;
    CollisionImage cdt;
};

Comparison compare(const Particles& reference, const CollisionImage& reference_cdt, const State& gpu, bool has_cdt) {
    Comparison result = lockstep::compare(reference, gpu.particles);
    if (has_cdt)
        result.add(lockstep::compare(reference_cdt, gpu.cdt));
    return result;
}

/// What the GPU has now, against what it had. Particles are only read back where they differ: a copy of 4 million
/// would be the peak of the whole run.
Comparison compare_again(const State& first, const GpuSide& gpu, const Scene& scene) {
    State again;
    Comparison result;
    if (gpu.has_cdt()) {
        read_side(gpu, scene, again.cdt);
        result = lockstep::compare(first.cdt, again.cdt);
    }
    if (!gpu.holds(first.particles)) {
        read_side(gpu, scene, again.particles);
        result.add(lockstep::compare(first.particles, again.particles));
    }
    return result;
}

std::uint64_t count_drawn(const CollisionImage& cdt) {
    const auto n = static_cast<std::ptrdiff_t>(cdt.texels.size());
    std::uint64_t drawn = 0;
#pragma omp parallel for simd reduction(+ : drawn) schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        drawn += cdt.texels[static_cast<std::size_t>(i)].a != 0.0F ? 1U : 0U;
    return drawn;
}

/// What a frame of a resync run came to, on both sides; `earlier`: what the frame before started from, null in frame 0.
struct RunFrame {
    int number;
    const FrameParams& params;
    const State& before;
    const State* earlier;
    ReferenceSimulation& reference;
    const State& gpu;
    bool particles_differ;
};

/// Judges the frames of a resync run that are not bit-equal.
class RunJudge {
  public:
    /// `has_cdt`: texels are judged too. `causes`: the mistake behind what diverges is looked for.
    RunJudge(const Scene& scene, const Profile& profile, const KnownOperations& known, bool has_cdt, bool causes)
        : scene_(scene), profile_(profile), known_(known), has_cdt_(has_cdt), seeks_causes_(causes),
          named_(named_mistakes(scene, profile)), step_causes_(named_, step_name(scene.switches)),
          listing_power_(scene, profile, known), power_(named_) {
        summary_.judges_leans = can_judge_leans(known, profile);
    }

    FrameVerdicts judge(const RunFrame& f) {
        const std::span<const std::int32_t> texels_of_points =
            f.particles_differ ? std::span<const std::int32_t>() : f.reference.texels_of_points();
        const JudgedFrame judged{scene_.obstacles,
                                 f.params,
                                 profile_,
                                 known_,
                                 f.before.particles,
                                 f.before.cdt,
                                 f.reference.particles(),
                                 f.reference.cdt(),
                                 f.gpu.particles,
                                 f.gpu.cdt,
                                 f.particles_differ,
                                 texels_of_points};
        FrameVerdicts verdicts = lockstep::judge(judged);
        if (!has_cdt_)
            verdicts.texels.clear();
        const bool diverges = keep_first(f.number, judged, verdicts);
        summary_.add(f.number, collision::particles, verdicts.particles);
        summary_.add(f.number, collision::cdt, verdicts.texels);
        if (diverges && seeks_causes_) {
            seek_causes(f, judged, verdicts);
            hint_.add(judged, verdicts);
        }
        return verdicts;
    }

    /// Tries on a frame's own states which mistakes would have shown.
    void measure_power(const RunFrame& f) {
        if (is_listing(scene_.switches)) {
            const FrameParams earlier_params = frame_params(scene_, std::max(f.number - 1, 0));
            FrameInputs inputs = frame_inputs(f, earlier_params);
            inputs.drawn_cdt = &f.reference.cdt();
            return listing_power_.add({f.number, inputs, f.reference.particles()});
        }
        constexpr int first_frames = 8;
        constexpr std::size_t items_tried = 256; // of each mistake in each such frame, whatever showed in others
        if ((f.number >= first_frames && f.number % first_frames != 0) || power_.has_seen_all())
            return;
        std::vector<std::size_t> hits;
        const float time = f.params.constants.collision_time;
        for (std::size_t i = 0; i < f.before.particles.size() && hits.size() < 4096; ++i)
            if (is_hit(f.before.particles.collide_time[i], f.reference.particles().collide_time[i], time))
                hits.push_back(i);
        const StepInputs inputs{f.before.particles, f.before.cdt, scene_.obstacles, f.params};
        const auto pass = step_pass(inputs);
        const SystemView before = step_state(inputs);
        const View reference = view(f.reference.particles());
        power_.add({*pass, profile_, known_, f.number, before, reference, reference}, hits, items_tried);
    }
    [[nodiscard]] PowerSummary power() const {
        return is_listing(scene_.switches) ? listing_power_.summary() : power_.summary();
    }

    [[nodiscard]] const std::vector<NamedMistake>& mistakes() const { return named_; }

    /// By which what diverges is legal, where that is judged by what was measured.
    [[nodiscard]] std::optional<Legal> wider_rule() const { return hint_.rule(); }

    /// Before any shift is convicted.
    [[nodiscard]] VerdictSummary summary() const {
        VerdictSummary summary = summary_;
        summary.causes[collision::particles] = step_causes_.findings();
        summary.causes[collision::cdt] =
            has_remedies(scene_.switches) ? drawn_causes_.findings() : texel_causes_.findings();
        return summary;
    }

  private:
    /// Whether there are divergent ones among the verdicts, and the first of them kept.
    bool keep_first(int frame, const JudgedFrame& judged, const FrameVerdicts& verdicts) {
        const auto divergent = [](const std::vector<ItemVerdict>& items) {
            return std::any_of(items.begin(), items.end(),
                               [](const ItemVerdict& item) { return item.kind == DifferenceClass::divergent; });
        };
        const bool diverges = divergent(verdicts.particles) || divergent(verdicts.texels);
        if (diverges && summary_.total(DifferenceClass::divergent) == 0)
            summary_.first = first_of(DifferenceClass::divergent, frame, judged, verdicts);
        else if (!summary_.first)
            summary_.first = first_of(DifferenceClass::undefined, frame, judged, verdicts);
        if (is_listing(scene_.switches) && summary_.judges_leans && !summary_.first_beyond_rounding)
            summary_.first_beyond_rounding = first_tie_beyond_rounding(frame, judged, verdicts);
        return diverges;
    }

    void seek_causes(const RunFrame& f, const JudgedFrame& judged, const FrameVerdicts& verdicts) {
        if (has_remedies(scene_.switches))
            drawn_causes_.add(judged, f.earlier != nullptr ? &f.earlier->cdt : nullptr, verdicts.texels);
        const FrameParams earlier_params = frame_params(scene_, std::max(f.number - 1, 0));
        const FrameInputs inputs = frame_inputs(f, earlier_params);
        add_causes(judged, verdicts, inputs, step_causes_, texel_causes_);
    }

    static FrameInputs frame_inputs(const RunFrame& f, const FrameParams& earlier_params) {
        FrameInputs inputs{
            .before = &f.before.particles, .cdt = &f.before.cdt, .params = &f.params, .drawn_cdt = &f.gpu.cdt};
        if (f.earlier != nullptr) {
            inputs.earlier = &f.earlier->particles;
            inputs.earlier_cdt = &f.earlier->cdt;
            inputs.earlier_params = &earlier_params;
        }
        return inputs;
    }

    const Scene& scene_;
    const Profile& profile_;
    KnownOperations known_;
    bool has_cdt_, seeks_causes_;
    VerdictSummary summary_{collision_schema()};
    TexelCauses texel_causes_;
    LegalHint hint_;
    std::vector<NamedMistake> named_;
    ItemCauseFinder step_causes_;
    DrawnCauseFinder drawn_causes_;
    CollisionPower listing_power_;
    PowerMeter power_;
};

/// What agreed without having been put to the test.
std::vector<std::string> untried(const CheckReport& report) {
    std::vector<std::string> all;
    if (report.hits == 0)
        all.emplace_back(no_hits);
    if (report.drawn_texels == 0 && report.expects_texels)
        all.emplace_back("nothing was drawn into the CDT");
    const FieldCount position = report.total[collision::position];
    if (position.nan > 0 && 2 * position.nan >= position.compared)
        all.emplace_back(fmt::format("{} of {} coordinates are NaN, of which any equals any other", position.nan,
                                     position.compared));
    return all;
}

/// Which frames of a run are compared, and what they need of those before.
class WantedFrames {
  public:
    explicit WantedFrames(const CheckOptions& options) : first_(options.first), only_(options.only) {}

    [[nodiscard]] bool has(int frame) const {
        return frame >= first_ && (only_.empty() || std::binary_search(only_.begin(), only_.end(), frame));
    }
    /// A frame needs the states of the two before it, and a CDT that was not recorded the particles before these.
    [[nodiscard]] bool needs(int frame) const {
        return has(frame) || has(frame + 1) || has(frame + 2) || has(frame + 3);
    }

  private:
    int first_;
    const std::vector<int>& only_;
};

} // namespace

CheckReport judge_frames(const Scene& scene, const Profile& profile, GpuSide& gpu, const FrameCheckOptions& options) {
    if (const std::string problem = size_problem(scene.start, scene.start.size()); !problem.empty())
        throw Error(fmt::format("{}: its start has {}", scene.name, problem));
    CheckReport report;
    report.schema = collision_schema();
    report.counts_hits = true;
    report.expects_texels = scene.switches.search == Search::cdt;
    report.particles = scene.start.size();
    report.first = options.first;
    report.frames_asked = options.frames - options.first;
    const WantedFrames wanted(options);
    ReferenceSimulation reference(scene, profile);
    State before{scene.start, empty_cdt(scene)};
    State now{{}, before.cdt};
    State earlier = now;
    const bool has_cdt = gpu.has_cdt();
    const bool judged = options.mode == CheckMode::resync;
    if (!judged && options.first > 0)
        throw Error(
            fmt::format("{}: --mode free runs from the start: a later frame follows from all before it", scene.name));
    RunJudge judge(scene, profile, options.known.value_or(measured_operations(profile)), has_cdt, options.causes);
    gpu.upload(before.particles, before.cdt);
    const auto repeats = [&](int frame) { return frame < options.repeated_frames && gpu.repeats(); };
    double begun = 0.0; // seconds that beginning the next frame took

    for (int frame = 0; frame < options.frames && !(options.stop != nullptr && *options.stop); ++frame) {
        const FrameParams params = frame_params(scene, frame);
        const bool repeat = repeats(frame);
        if (!repeat && !wanted.needs(frame)) {
            gpu.step(params);
            continue;
        }
        const std::size_t present = gpu.present(frame);
        if (!judged && present < scene.start.size())
            throw Error(fmt::format("{}: frame {} has {} of {} particles; --mode free needs all in every frame",
                                    scene.name, frame, present, scene.start.size()));
        AbsentParticles absent_before, absent_after;
        absent_before.hide(before.particles, present);
        FrameTimes times;
        times.gpu = std::exchange(begun, 0.0);
        if (repeat)
            gpu.lay_canary();
        {
            const Stopwatch watch(times.gpu);
            gpu.step(params);
        }
        {
            const Stopwatch watch(times.readback);
            read_side(gpu, scene, now.particles, now.cdt);
            absent_after.hide(now.particles, present);
        }
        if (repeat) {
            gpu.find_canary(now.particles, now.cdt, frame);
            gpu.repeat_step(params);
            const Comparison repeated = compare_again(now, gpu, scene);
            if (!repeated.agree()) {
                note_difference(report, frame, repeated);
                report.verdict = Verdict::nondeterministic;
                report.total.add(repeated);
                report.frames = std::max(frame + 1 - options.first, 1);
                return report;
            }
        }
        if (frame + 1 < options.frames && !repeats(frame + 1)) {
            const Stopwatch watch(begun);
            gpu.begin_step(frame_params(scene, frame + 1));
        }
        const auto go_on = [&] {
            std::swap(earlier, before);
            std::swap(before, now);
            absent_after.put_back(before.particles);
        };
        if (!wanted.has(frame)) {
            if (!has_cdt)
                reference.draw(before.particles, now.particles, params, now.cdt);
            go_on();
            continue;
        }
        {
            const Stopwatch watch(times.reference);
            if (judged)
                reference.step_from(before.particles, before.cdt, params);
            else
                reference.step(params);
        }
        Comparison comparison;
        {
            const Stopwatch watch(times.compare);
            comparison = compare(reference.particles(), reference.cdt(), now, has_cdt);
            if (!has_cdt && comparison.agree() && judged)
                now.cdt = reference.cdt();
            else if (!has_cdt)
                reference.draw(before.particles, now.particles, params, now.cdt);
            if (!comparison.agree() || options.mode == CheckMode::free)
                note_difference(report, frame, comparison);
            report.total.add(comparison);
            report.hits += count_hits(before.particles.collide_time, reference.particles().collide_time,
                                      params.constants.collision_time);
            report.drawn_texels += count_drawn(reference.cdt());
        }
        std::optional<FrameVerdicts> verdicts;
        const RunFrame run{frame,
                           params,
                           before,
                           frame > 0 ? &earlier : nullptr,
                           reference,
                           now,
                           comparison.differing(collision::particles) > 0};
        if (judged && options.power) {
            const Stopwatch watch(times.power);
            judge.measure_power(run);
        }
        if (judged && !comparison.agree()) {
            const Stopwatch watch(times.judge);
            verdicts = judge.judge(run);
        }
        report.times.push_back(times);
        ++report.frames;
        if (options.on_state)
            options.on_state({frame, reference.particles(), reference.cdt(), now.particles, now.cdt, comparison,
                              verdicts ? &*verdicts : nullptr});
        go_on();
        if (options.on_frame)
            options.on_frame(report.frames);
    }
    if (report.total.compared() == 0)
        throw Error(fmt::format("{}: nothing was compared: {} frames of {} particles", scene.name, report.frames,
                                report.particles));
    if (judged) {
        report.verdicts = judge.summary();
        report.wider_rule = judge.wider_rule();
        report.power = judge.power();
        note_refuting(report.power, judge.mistakes());
    }
    report.reference_hash = state_hash(reference.particles(), reference.cdt());
    report.gpu_hash = state_hash(before.particles, before.cdt);
    if (options.last_start != nullptr)
        *options.last_start = std::move(earlier.particles);
    return report;
}

void conclude(CheckReport& report) {
    if (report.verdict == Verdict::nondeterministic)
        return;
    if (report.verdicts) {
        report.verdicts->convict_shift();
        report.power.conclude();
        refute_causes(report);
    }
    report.verdict = verdict_on(report);
    if (report.verdict != Verdict::divergent && report.verdict != Verdict::differ)
        report.untried = untried(report);
}

CheckReport check(const Scene& scene, const Profile& profile, GpuSide& gpu, const FrameCheckOptions& options) {
    CheckReport report = judge_frames(scene, profile, gpu, options);
    conclude(report);
    return report;
}

} // namespace lockstep
