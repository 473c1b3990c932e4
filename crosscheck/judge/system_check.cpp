#include "crosscheck/judge/system_check.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/judge/agreeing_frames.hpp"
#include "crosscheck/judge/append_judge.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/item_hint.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/power.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/judge/untried.hpp"
#include "crosscheck/judge/unwritten.hpp"
#include "crosscheck/judge/wrong_step.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"
#include "reference/system/stored_pass.hpp"

namespace lockstep {
namespace {

/// Goes on from what the GPU made of one buffer; `earlier` is what its pass started from.
void go_on(SystemState& before, SystemState& now, SystemState& earlier, std::uint8_t made) {
    for (std::uint8_t r = 0; r < before.schema().resources.size(); ++r)
        if (r != made)
            earlier.take(r, before);
    earlier.swap(made, before);
    before.swap(made, now);
}

class SystemChecker {
  public:
    SystemChecker(const System& system, SystemSide& gpu, const CheckOptions& options, const CheckWatch& watch)
        : system_(system), gpu_(gpu), options_(options), watch_(watch), profile_(gpu.describe().profile),
          known_(options.known.value_or(measured_operations(profile_))), judged_(options.mode == CheckMode::resync),
          passes_(stored_passes(system.passes, system.schema)), summary_(system.schema), has_run_(system.passes.size()),
          is_exercised_(system.passes.size()), has_cause_(system.passes.size()), unwritten_(system.passes.size()),
          append_causes_(system.passes.size()), power_(system.mistakes), paces_(system.passes.size()),
          earlier_(system.passes.size()), before_(system.start), now_(system.start), reference_(system.start),
          made_(system.start) {
        for (const auto& pass : system.passes)
            causes_.emplace_back(system.mistakes, pass->name());
        report_.schema = system.schema;
        report_.particles = system.start.extent(0).count();
        report_.frames_asked = options.frames;
    }

    CheckReport run() {
        gpu_.upload(before_.view());
        while (frame_ < options_.frames && report_.ended_by.empty() && !(options_.stop != nullptr && *options_.stop)) {
            const bool has_one_answer = run_frame();
            report_.frames = ++frame_;
            if (!has_one_answer) {
                report_.verdict = Verdict::nondeterministic;
                return std::move(report_);
            }
        }
        conclude();
        return std::move(report_);
    }

  private:
    // A frame.

    /// False where the GPU gave two answers.
    bool run_frame() {
        times_ = {};
        try {
            for (std::size_t p = 0; p < system_.passes.size(); ++p)
                if (system_.passes[p]->runs(frame_) && !run_pass_of_frame(p))
                    return false;
        } catch (const Error& error) {
            // What diverged may lead anywhere, and is the verdict already.
            if (!judged_ || summary_.total(DifferenceClass::divergent) == 0)
                throw;
            report_.ended_by = error.what();
        }
        report_.times.push_back(times_);
        if (watch_.on_frame) {
            part();
            watch_.on_frame(frame_, reference_, before_);
        }
        if (options_.on_frame)
            options_.on_frame(frame_ + 1);
        return true;
    }

    bool run_pass_of_frame(std::size_t p) {
        const ItemPass& pass = *passes_[p];
        const std::uint8_t r = pass.resource();
        if (!pass.continues() && !dispatch(p))
            return false;
        is_exercised_[p] = is_exercised_[p] || !ran_over_nothing_;
        const SystemState& start = judged_ ? before_ : reference_;
        const SystemView from = start.view();
        run_twin(p, start);
        const bool holds = gpu_holds_made(p, from);
        if (!holds)
            read();
        const Comparison comparison = compare_made(p, from, holds);
        if (judged_ && paces_[p].is_due())
            measure_power(p, from);

        const SystemView earlier = earlier_[p] ? earlier_[p]->view() : SystemView();
        const View by_reference = std::as_const(made_)[r], by_gpu = holds ? by_reference : std::as_const(now_)[r];
        JudgedPass one{pass, profile_, known_, frame_, from, by_reference, by_gpu, earlier_[p] ? &earlier : nullptr};
        one.text = text_of(system_, p);
        const bool differs = judged_ && comparison.differing(r) > 0;
        const std::vector<ItemVerdict> verdicts = differs ? judge(one, p) : std::vector<ItemVerdict>();
        if (watch_.on_pass)
            watch_.on_pass({p, one, comparison, verdicts});
        if (differs && pass.derived())
            inherited_.insert(r);
        keep_made(p, holds);
        return true;
    }

    // A dispatch on the GPU.

    /// False where it gives two answers.
    bool dispatch(std::size_t p) {
        put_right(gpu_, before_, reference_, inherited_);
        const bool repeats = frame_ < options_.repeated_frames && gpu_.repeats();
        if (repeats)
            gpu_.lay_canary(p);
        dispatch_ = p;
        is_read_ = false;
        {
            const Stopwatch timing(times_.gpu);
            gpu_.step(p, frame_);
        }
        ran_over_nothing_ = gpu_.ran_over() == std::uint64_t{0};
        if (repeats || !holds_others(gpu_, system_, p, [&](std::uint8_t r) { return left(r); }))
            read();
        return !repeats || repeat(p);
    }

    /// The GPU's own state of a buffer or image before the dispatch.
    [[nodiscard]] View left(std::uint8_t r) const {
        return std::as_const(!judged_ && shared_.contains(r) ? reference_ : before_)[r];
    }

    /// What the GPU left, where that was not read yet.
    void read() {
        if (std::exchange(is_read_, true))
            return;
        part();
        const Stopwatch timing(times_.readback);
        gpu_.read(now_);
        expect_untouched(system_, dispatch_, before_, now_, frame_);
    }

    bool repeat(std::size_t p) {
        const ItemPass& pass = *passes_[p];
        const std::uint8_t r = pass.resource();
        find_canary(pass, now_, frame_);
        expect_left(gpu_, system_, p, before_, now_, frame_);
        SystemState again = now_;
        gpu_.repeat_step(p, frame_);
        gpu_.read(again);
        const View one = std::as_const(now_)[r], other = std::as_const(again)[r];
        const Comparison repeated = compare(one, other);
        if (pass.unordered() && watch_.on_two_runs)
            watch_.on_two_runs(p, frame_, repeated);
        if (!repeated.agree() && !pass.unordered() && !same_but_for_order(pass, {before_.view(), frame_}, one, other)) {
            note_difference(report_, frame_, repeated);
            report_.total.add(repeated);
            return false;
        }
        now_ = std::move(again);
        return true;
    }

    // The reference beside it.

    /// The first run of a pass shows whether its twin keeps what it says.
    void run_twin(std::size_t p, const SystemState& start) {
        const ItemPass& pass = *passes_[p];
        const std::uint8_t r = pass.resource();
        try {
            const Stopwatch timing(times_.reference);
            const bool is_known = has_run_[p];
            has_run_[p] = true;
            if (is_known)
                return run_pass(pass, start, frame_, profile_, made_);
            run_pass(pass, {start.view(), frame_}, profile_, made_[r]);
            expect_kept(pass, start[r], std::as_const(made_)[r], frame_);
        } catch (const OutsideState& error) {
            throw Error(fmt::format("frame {}: the twin of {}: {}", frame_, pass.name(), error.what()));
        }
    }

    /// Whether the GPU holds what the twin made, as far as can be seen without reading it back.
    bool gpu_holds_made(std::size_t p, const SystemView& from) {
        if (is_read_)
            return false;
        const Stopwatch timing(times_.compare);
        const std::uint8_t r = system_.passes[p]->resource();
        const View made = std::as_const(made_)[r];
        return gpu_.holds(shared_.contains(r) ? without_kept(made, from[r], gpu_, dispatch_) : made) == true;
    }

    Comparison compare_made(std::size_t p, const SystemView& from, bool holds) {
        const Stopwatch timing(times_.compare);
        const ItemPass& pass = *passes_[p];
        const std::uint8_t r = pass.resource();
        const View made = std::as_const(made_)[r];
        Comparison comparison = holds ? agreement(made) : compare(made, std::as_const(now_)[r]);
        if (!comparison.agree() || !judged_)
            note_difference(report_, frame_, comparison);
        report_.total.add(comparison);
        const View by_gpu = holds ? made : std::as_const(now_)[r], from_gpu = left(r);
        untried_.note(pass, {from[r], made}, {from_gpu, by_gpu});
        return comparison;
    }

    void measure_power(std::size_t p, const SystemView& from) {
        const Stopwatch timing(times_.power);
        const ItemPass& pass = *passes_[p];
        const View agreed = std::as_const(made_)[pass.resource()];
        JudgedPass tried{pass, profile_, known_, frame_, from, agreed, agreed};
        tried.prepare();
        paces_[p].tried(power_.add(tried, items_unlike_most(agreed)));
    }

    /// The pass once more, over a pattern in its buffer. Nothing where it cannot be laid: buffers that are changed in
    /// place have no room for it.
    std::optional<Unwritten> run_over_canary(const JudgedPass& one, const std::vector<ItemVerdict>& verdicts) {
        const std::span<const Field> fields = one.gpu.fields();
        if (one.pass.continues() || !gpu_.repeats() ||
            std::ranges::any_of(fields, [](const Field& field) { return !field.block.empty(); }))
            return {};
        gpu_.upload(std::as_const(before_).view());
        gpu_.lay_canary(dispatch_);
        gpu_.step(dispatch_, frame_);
        SystemState again = now_;
        gpu_.read(again);
        gpu_.upload(std::as_const(now_).view());
        return unwritten_in(std::as_const(again)[one.pass.resource()], verdicts);
    }

    std::vector<ItemVerdict> judge(JudgedPass& one, std::size_t p) {
        const Stopwatch timing(times_.judge);
        const std::uint8_t r = one.pass.resource();
        one.prepare();
        std::vector<ItemVerdict> verdicts = judge_items(one);
        const std::uint64_t divergent_before = summary_.total(DifferenceClass::divergent);
        summary_.add(frame_, r, verdicts);
        const bool diverges = summary_.total(DifferenceClass::divergent) > divergent_before;
        if (diverges)
            hint_.add(one, verdicts);
        if (diverges && divergent_before == 0)
            note_first(one, p, verdicts, DifferenceClass::divergent);
        else if (!summary_.first)
            note_first(one, p, verdicts, DifferenceClass::undefined);
        if (diverges && options_.causes && one.pass.appended(one.input()))
            append_causes_[p].add(one);
        else if (diverges && options_.causes) {
            if (!has_cause_[p])
                if (const std::optional<Unwritten> left = run_over_canary(one, verdicts)) {
                    one.surely_written = left->none;
                    unwritten_[p] = left->cause;
                }
            has_cause_[p] = true;
            causes_[p].add(one, verdicts);
        }
        return verdicts;
    }

    void note_first(const JudgedPass& one, std::size_t p, const std::vector<ItemVerdict>& verdicts,
                    DifferenceClass kind) {
        for (const ItemVerdict& verdict : verdicts)
            if (verdict.kind == kind) {
                WrongStep wrong = wrong_step_of_item(one, verdict.index);
                wrong.step = fmt::format("{}, {}", one.pass.name(), wrong.step);
                summary_.first = {{frame_, one.pass.resource(), verdict.index}, verdict, std::move(wrong), p};
                return;
            }
    }

    // What both go on from.

    /// Each side its own state of what is shared.
    void part() {
        for (const std::uint8_t r : shared_)
            judged_ ? reference_.take(r, before_) : before_.take(r, reference_);
        shared_.clear();
    }

    void keep_made(std::size_t p, bool holds) {
        const ItemPass& pass = *passes_[p];
        const std::uint8_t r = pass.resource();
        if (holds)
            shared_.insert(r);
        else
            shared_.erase(r);
        if (!holds || !judged_)
            reference_.swap(r, made_);
        if (holds && !judged_)
            return;
        SystemState& made_by_gpu = holds ? made_ : now_;
        // The state that what is derived follows from is the one it was judged in.
        if (!judged_ || pass.derived()) {
            before_.swap(r, made_by_gpu);
            return;
        }
        if (!earlier_[p])
            earlier_[p] = system_.start;
        go_on(before_, made_by_gpu, *earlier_[p], r);
    }

    // The report.

    void conclude() {
        if (report_.total.compared() == 0)
            throw Error(fmt::format("{}: nothing was compared: {} frames", system_.name, report_.frames));
        if (judged_)
            conclude_verdicts();
        part();
        report_.verdict = verdict_on(report_);
        report_.without_effect = untried_.without_effect();
        if (report_.verdict != Verdict::divergent && report_.verdict != Verdict::differ)
            report_.untried = untried();
        report_.reference_hash = state_hash(reference_);
        report_.gpu_hash = state_hash(before_);
    }

    std::vector<std::string> untried() {
        for (std::size_t p = 0; p < has_run_.size(); ++p)
            if (!has_run_[p])
                untried_.note_idle(system_.passes[p]->name());
            else if (!is_exercised_[p])
                untried_.note_empty(*system_.passes[p]);
        return untried_.texts(report_);
    }

    void conclude_verdicts() {
        for (std::size_t p = 0; p < causes_.size(); ++p) {
            const CauseFindings found = !unwritten_[p].best.empty() ? unwritten_[p]
                                        : append_causes_[p].empty() ? causes_[p].findings()
                                                                    : append_causes_[p].findings();
            CauseFindings& of_buffer = summary_.causes[system_.passes[p]->resource()];
            const bool knows_none = system_.mistakes.empty() && found.best.empty(); // then there is nothing to say
            if (found.divergent > of_buffer.divergent && !knows_none)
                of_buffer = found;
        }
        report_.verdicts = std::move(summary_);
        report_.wider_rule = hint_.rule();
        for (std::size_t p = 0; p < has_run_.size(); ++p)
            if (!has_run_[p])
                power_.note_idle(system_.passes[p]->name());
        report_.power = power_.summary();
        report_.power.conclude();
        note_refuting(report_.power, system_.mistakes);
        refute_causes(report_);
    }

    const System& system_;
    SystemSide& gpu_;
    const CheckOptions& options_;
    const CheckWatch& watch_;
    const Profile profile_;
    const KnownOperations known_;
    const bool judged_;                                         ///< each pass by itself, not two runs side by side
    const std::vector<std::shared_ptr<const ItemPass>> passes_; ///< the system's, as images store what they make

    CheckReport report_;
    VerdictSummary summary_;
    std::vector<bool> has_run_;            ///< each pass, at least once
    std::vector<bool> is_exercised_;       ///< the same, over one vertex or invocation at least
    std::vector<ItemCauseFinder> causes_;  ///< of each pass, as those that follow
    std::vector<bool> has_cause_;          ///< one was looked for
    std::vector<CauseFindings> unwritten_; ///< of what diverges first
    std::vector<AppendCause> append_causes_;
    ItemHint hint_;
    PowerMeter power_;
    std::vector<PowerPace> paces_;
    std::vector<std::optional<SystemState>> earlier_; ///< what the pass last started from

    SystemState before_, now_;         ///< the GPU's, before a dispatch and after it
    SystemState reference_;            ///< the reference's, run free; judged, what was right of the pass before
    SystemState made_;                 ///< the buffer of the pass that runs is the reference's
    std::set<std::uint8_t> inherited_; ///< buffers that are derived, and not the reference's
    /// Of these one state has what both are: judged, the GPU's; run free, the reference's.
    std::set<std::uint8_t> shared_;
    UntriedParts untried_;

    int frame_ = 0;
    FrameTimes times_;         ///< of the frame
    std::size_t dispatch_ = 0; ///< its first pass
    bool is_read_ = false;     ///< `now_` is what the GPU left
    bool ran_over_nothing_ = false;
};

} // namespace

CheckReport check(const System& system, SystemSide& gpu, const CheckOptions& options, const CheckWatch& watch) {
    check_system(system);
    return SystemChecker(system, gpu, options, watch).run();
}

} // namespace lockstep
