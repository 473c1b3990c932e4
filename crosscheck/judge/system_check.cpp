#include "crosscheck/judge/system_check.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/agreeing_frames.hpp"
#include "crosscheck/judge/append_judge.hpp"
#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/item_hint.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/judge/power.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/judge/wrong_step.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

void check_system(const System& system) {
    if (system.passes.empty())
        throw Error(fmt::format("{}: a system without passes does nothing", system.schema.system));
    if (!system.start.is_of(system.schema))
        throw Error(fmt::format("{}: its start is no state of its schema; right is SystemState(schema, sizes)",
                                system.schema.system));
    for (const auto& pass : system.passes) {
        if (pass == nullptr)
            throw Error(fmt::format("{}: a pass is null; right is item_pass(options, twin)", system.schema.system));
        if (pass->resource() >= system.schema.resources.size())
            throw Error(
                fmt::format("{}: pass {} makes the items of no buffer or image", system.schema.system, pass->name()));
        if (system.start.extent(pass->resource()).count() == 0)
            throw Error(fmt::format("{}: nothing would be compared: there are no {}s", system.schema.system,
                                    system.schema.resources[pass->resource()].item));
    }
    for (const NamedMistake& named : system.mistakes) {
        bool known = false;
        for (const auto& pass : system.passes)
            known = known || pass->name() == named.pass;
        if (!known)
            throw Error(fmt::format("{}: mistake {} is made in pass '{}', which there is not", system.schema.system,
                                    named.name, named.pass));
    }
}

/// A frame in which nothing but copies was made proves little.
std::uint64_t changed_items(const View& before, const View& after) { return differing_items(before, after).size(); }

/// The words that agree in a state of NaN prove nothing.
std::vector<std::string> untried(const CheckReport& report, std::uint64_t changed) {
    std::vector<std::string> all;
    if (changed == 0)
        all.emplace_back("no pass changed anything");
    std::uint64_t compared = 0, nan = 0;
    for (const ResourceCount& resource : report.total.resources)
        for (const FieldCount& field : resource.fields) {
            compared += field.compared;
            nan += field.nan;
        }
    if (nan > 0 && 2 * nan >= compared)
        all.emplace_back(fmt::format("{} of {} values are NaN, of which any equals any other", nan, compared));
    return all;
}

/// Whether mistakes are tried in the `run`-th run of a pass: later ones come to few new places.
bool power_is_tried(std::size_t run) { return run < 48 || run % 4 == 0; }

/// The passes of one dispatch: `first`, and those that continue it.
std::size_t end_of_dispatch(const System& system, std::size_t first) {
    std::size_t end = first + 1;
    while (end < system.passes.size() && system.passes[end]->continues())
        ++end;
    return end;
}

/// A dispatch writes the buffers of its passes and no other.
void expect_untouched(const System& system, std::size_t first, const SystemState& before, const SystemState& now,
                      int frame) {
    const ItemPass& pass = *system.passes[first];
    const std::vector<std::uint8_t> written = written_by(system, first);
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r) {
        if (std::find(written.begin(), written.end(), r) != written.end())
            continue;
        const auto changed = differing_items(before[r], now[r]);
        if (!changed.empty())
            throw Error(fmt::format("frame {}: {} changed {}; it must write {} alone", frame, pass.name(),
                                    item_name(system.schema.resources[r], now.extent(r), changed.front()),
                                    system.schema.resources[pass.resource()].title));
    }
}

void find_canary(const ItemPass& pass, const SystemState& now, int frame) {
    const View view = now[pass.resource()];
    if (const std::size_t item = find_word(view, canary_word); item < view.count())
        throw Error(fmt::format("frame {}: {} did not write {}: its record still holds what was laid there before",
                                frame, pass.name(), item_name(view.about(), view.extent, item)));
}

/// What a dispatch reads of the buffers that it makes is another copy, which it leaves alone. Where nothing was made,
/// the host may have left it out, and the other copy is none that was read.
void expect_left(const SystemSide& gpu, const System& system, std::size_t first, const SystemState& before,
                 const SystemState& now, int frame) {
    for (const std::uint8_t r : written_by(system, first))
        if (gpu.left(before[r]) == false && !differing_items(before[r], now[r]).empty())
            throw Error(fmt::format("frame {}: {} changed {} in the copy that it reads; it must write the other alone",
                                    frame, system.passes[first]->name(), system.schema.resources[r].title));
}

/// Gives a state, and the GPU, what is right of the buffers that are derived from others.
void put_right(SystemSide& gpu, SystemState& state, const SystemState& right, std::set<std::uint8_t>& wrong) {
    if (wrong.empty())
        return;
    for (const std::uint8_t r : wrong)
        state.take(r, right);
    wrong.clear();
    gpu.upload(std::as_const(state).view());
}

/// Whether the GPU surely left alone all that the dispatch of pass `first` does not write; `before(r)` has it.
template <class Before>
bool holds_others(const SystemSide& gpu, const System& system, std::size_t first, const Before& before) {
    const std::vector<std::uint8_t> written = written_by(system, first);
    const std::optional<std::vector<std::uint8_t>> reached = gpu.reached_by(first);
    const auto is_among = [](const std::vector<std::uint8_t>& all, std::uint8_t r) {
        return std::ranges::find(all, r) != all.end();
    };
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r)
        if (!is_among(written, r) && (!reached || is_among(*reached, r)) && gpu.holds(before(r)) != true)
            return false;
    return true;
}

/// Goes on from what the GPU made of one buffer; `earlier` is what its pass started from.
void go_on(SystemState& before, SystemState& now, SystemState& earlier, std::uint8_t made) {
    for (std::uint8_t r = 0; r < before.schema().resources.size(); ++r)
        if (r != made)
            earlier.take(r, before);
    earlier.swap(made, before);
    before.swap(made, now);
}

/// What the GPU left, but for the buffers of passes that continue `pass`: they were not judged yet.
SystemState left_by(const System& system, std::size_t pass, const SystemState& before, const SystemState& now) {
    SystemState left = now;
    for (std::size_t p = pass + 1; p < end_of_dispatch(system, pass); ++p)
        left.take(system.passes[p]->resource(), before);
    return left;
}

} // namespace

std::uint64_t state_hash(const SystemState& state) {
    std::uint64_t hash = state_hash(state[0]);
    for (std::uint8_t r = 1; r < state.schema().resources.size(); ++r)
        hash = combined_hash(hash, state_hash(state[r]));
    return hash;
}

std::vector<ToldValue> told_of(SystemSide& gpu, std::size_t pass, const JudgedPass& judged, std::size_t item) {
    std::vector<ToldValue> told;
    for (const CapturedVertex& vertex : gpu.trace(pass, judged.frame, item))
        for (const CapturedOutput& output : vertex.outputs) {
            ToldValue value{output.name, {}};
            for (std::size_t c = 0; c < output.words.size(); ++c)
                value.values.push_back(output.is_float ? output.number(c) : static_cast<float>(output.integer(c)));
            told.push_back(std::move(value));
        }
    const std::vector<ToldValue> written = told_by_state(judged.pass, judged.gpu, item);
    told.insert(told.end(), written.begin(), written.end());
    return told;
}

std::vector<std::uint8_t> written_by(const System& system, std::size_t first) {
    std::vector<std::uint8_t> written;
    for (std::size_t p = first; p < end_of_dispatch(system, first); ++p)
        if (const std::uint8_t r = system.passes[p]->resource();
            std::find(written.begin(), written.end(), r) == written.end())
            written.push_back(r);
    return written;
}

void run_gpu(const System& system, SystemSide& gpu, int frames,
             const std::function<bool(std::size_t pass, int frame, const SystemState& state)>& work) {
    check_system(system);
    SystemState before = system.start, now = system.start;
    gpu.upload(before.view());
    const int repeated_frames = gpu.repeats() ? CheckOptions().repeated_frames : 0;
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            const ItemPass& pass = *system.passes[p];
            if (!pass.runs(frame) || pass.continues())
                continue;
            if (frame < repeated_frames)
                gpu.lay_canary(p);
            gpu.step(p, frame);
            gpu.read(now);
            expect_untouched(system, p, before, now, frame);
            if (frame < repeated_frames) {
                find_canary(pass, now, frame);
                SystemState again = now;
                gpu.repeat_step(p, frame);
                gpu.read(again);
                for (const std::uint8_t r : written_by(system, p)) {
                    const View one = std::as_const(now)[r], other = std::as_const(again)[r];
                    if (!compare(one, other).agree() && !pass.unordered() &&
                        !(r == pass.resource() && same_but_for_order(pass, {before.view(), frame}, one, other)))
                        throw Error(fmt::format(
                            "the GPU gave two answers to frame {}, pass {}; check reports where they differ", frame,
                            pass.name()));
                }
                now = std::move(again);
            }
            if (!work(p, frame, now))
                return;
            before = now;
        }
}

CheckReport check(const System& system, SystemSide& gpu, const CheckOptions& options, const CheckWatch& watch) {
    check_system(system);
    const Profile profile = gpu.describe().profile;
    const KnownOperations known = options.known.value_or(measured_operations(profile));
    const bool judged = options.mode == CheckMode::resync;
    CheckReport report;
    report.schema = system.schema;
    report.particles = system.start.extent(0).count();
    report.frames_asked = options.frames;
    VerdictSummary summary(system.schema);
    std::vector<ItemCauseFinder> causes;
    for (std::size_t p = 0; p < system.passes.size(); ++p)
        causes.emplace_back(system.mistakes, system.passes[p]->name());
    std::vector<AppendCause> append_causes(system.passes.size());
    ItemHint hint;
    PowerMeter power(system.mistakes);
    std::vector<std::size_t> runs(system.passes.size());                   // of each pass
    std::vector<std::optional<SystemState>> earlier(system.passes.size()); // what each pass last started from
    SystemState before = system.start, now = system.start, reference = system.start;
    SystemState made = system.start; // the buffer of the pass that runs is the reference's
    std::uint64_t changed = 0;
    std::set<std::uint8_t> inherited; // buffers that are derived, and not the reference's
    // Of these one state has what both are: judged, the GPU's; run free, the reference's.
    std::set<std::uint8_t> shared;
    const auto left = [&](std::uint8_t r) {
        return std::as_const(!judged && shared.contains(r) ? reference : before)[r];
    };
    const auto part = [&] {
        for (const std::uint8_t r : shared)
            judged ? reference.take(r, before) : before.take(r, reference);
        shared.clear();
    };
    gpu.upload(before.view());

    bool stopped = false;
    for (int frame = 0; frame < options.frames && !stopped && !(options.stop != nullptr && *options.stop); ++frame) {
        FrameTimes times;
        std::size_t dispatch = 0; // its first pass
        bool is_read = false;     // `now` is what the GPU left
        const auto read = [&] {
            if (std::exchange(is_read, true))
                return;
            part();
            const Stopwatch timing(times.readback);
            gpu.read(now);
            expect_untouched(system, dispatch, before, now, frame);
        };
        try {
            for (std::size_t p = 0; p < system.passes.size(); ++p) {
                const ItemPass& pass = *system.passes[p];
                if (!pass.runs(frame))
                    continue;
                const std::uint8_t r = pass.resource();
                if (!pass.continues())
                    put_right(gpu, before, reference, inherited);
                const bool repeat = frame < options.repeated_frames && gpu.repeats() && !pass.continues();
                if (repeat)
                    gpu.lay_canary(p);
                if (!pass.continues()) {
                    dispatch = p;
                    is_read = false;
                    {
                        const Stopwatch timing(times.gpu);
                        gpu.step(p, frame);
                    }
                    if (repeat || !holds_others(gpu, system, p, left))
                        read();
                }
                if (repeat) {
                    find_canary(pass, now, frame);
                    expect_left(gpu, system, p, before, now, frame);
                    SystemState again = now;
                    gpu.repeat_step(p, frame);
                    gpu.read(again);
                    const Comparison repeated = compare(now[r], again[r]);
                    if (pass.unordered() && watch.on_two_runs)
                        watch.on_two_runs(p, frame, repeated);
                    if (!repeated.agree() && !pass.unordered() &&
                        !same_but_for_order(pass, {before.view(), frame}, std::as_const(now)[r],
                                            std::as_const(again)[r])) {
                        note_difference(report, frame, repeated);
                        report.verdict = Verdict::nondeterministic;
                        report.total.add(repeated);
                        report.frames = frame + 1;
                        return report;
                    }
                    now = std::move(again);
                }
                const SystemView from = judged ? before.view() : reference.view();
                try {
                    const Stopwatch timing(times.reference);
                    run_pass(pass, {from, frame}, profile, made[r]);
                } catch (const OutsideState& error) {
                    throw Error(fmt::format("frame {}: the twin of {}: {}", frame, pass.name(), error.what()));
                }
                bool holds = false; // what the twin made
                if (!is_read) {
                    const Stopwatch timing(times.compare);
                    holds = gpu.holds(std::as_const(made)[r]) == true;
                }
                if (!holds)
                    read();
                Comparison comparison;
                {
                    const Stopwatch timing(times.compare);
                    comparison = holds ? agreement(std::as_const(made)[r])
                                       : compare(std::as_const(made)[r], std::as_const(now)[r]);
                    if (!comparison.agree() || !judged)
                        note_difference(report, frame, comparison);
                    report.total.add(comparison);
                    if (changed == 0)
                        changed = changed_items(from[r], std::as_const(made)[r]);
                }
                if (judged && power_is_tried(runs[p]++)) {
                    const Stopwatch timing(times.power);
                    const View agreed = std::as_const(made)[r];
                    JudgedPass tried{pass, profile, known, frame, from, agreed, agreed};
                    tried.prepare();
                    power.add(tried, {});
                }
                const SystemView earlier_view = earlier[p] ? earlier[p]->view() : SystemView();
                const View reference_view = std::as_const(made)[r];
                const View gpu_view = holds ? reference_view : std::as_const(now)[r];
                JudgedPass one{pass, profile,        known,    frame,
                               from, reference_view, gpu_view, earlier[p] ? &earlier_view : nullptr};
                std::vector<ItemVerdict> verdicts;
                if (judged && comparison.differing(r) > 0) {
                    const Stopwatch timing(times.judge);
                    one.prepare();
                    verdicts = judge_items(one);
                    const std::uint64_t divergent_before = summary.total(DifferenceClass::divergent);
                    summary.add(frame, r, verdicts);
                    const bool diverges = summary.total(DifferenceClass::divergent) > divergent_before;
                    const auto first = [&](DifferenceClass kind) {
                        for (const ItemVerdict& verdict : verdicts)
                            if (verdict.kind == kind) {
                                WrongStep wrong = wrong_step_of_item(one, verdict.index);
                                wrong.step = fmt::format("{}, {}", one.pass.name(), wrong.step);
                                summary.first = {{frame, r, verdict.index}, verdict, std::move(wrong), p};
                                return;
                            }
                    };
                    if (diverges)
                        hint.add(one, verdicts);
                    if (diverges && divergent_before == 0)
                        first(DifferenceClass::divergent);
                    else if (!summary.first)
                        first(DifferenceClass::undefined);
                    if (diverges && options.causes && pass.appended(one.input()))
                        append_causes[p].add(one);
                    else if (diverges && options.causes)
                        causes[p].add(one, verdicts);
                }
                if (watch.on_pass)
                    watch.on_pass({p, one, comparison, verdicts});
                if (judged && pass.derived() && comparison.differing(r) > 0)
                    inherited.insert(r);
                if (holds)
                    shared.insert(r);
                else
                    shared.erase(r);
                if (!holds || !judged)
                    reference.swap(r, made);
                if (holds && !judged)
                    continue;
                SystemState& made_by_gpu = holds ? made : now;
                // The state that what is derived follows from is the one it was judged in.
                if (!judged || pass.derived()) {
                    before.swap(r, made_by_gpu);
                    continue;
                }
                if (!earlier[p])
                    earlier[p] = system.start;
                go_on(before, made_by_gpu, *earlier[p], r);
            }
        } catch (const Error& error) {
            // What diverged may lead anywhere, and is the verdict already.
            if (!judged || summary.total(DifferenceClass::divergent) == 0)
                throw;
            stopped = true;
            report.ended_by = error.what();
        }
        report.times.push_back(times);
        report.frames = frame + 1;
        if (watch.on_frame) {
            part();
            watch.on_frame(frame, reference, before);
        }
        if (options.on_frame)
            options.on_frame(report.frames);
    }
    if (report.total.compared() == 0)
        throw Error(fmt::format("{}: nothing was compared: {} frames", system.name, report.frames));
    if (judged) {
        for (std::size_t p = 0; p < causes.size(); ++p) {
            const CauseFindings found = append_causes[p].empty() ? causes[p].findings() : append_causes[p].findings();
            CauseFindings& of_buffer = summary.causes[system.passes[p]->resource()];
            if (found.divergent > of_buffer.divergent)
                of_buffer = found;
        }
        report.verdicts = summary;
        report.wider_rule = hint.rule();
        report.power = power.summary();
        report.power.conclude();
        note_refuting(report.power, system.mistakes);
        refute_causes(report);
    }
    part();
    report.verdict = verdict_on(report);
    if (report.verdict != Verdict::divergent && report.verdict != Verdict::differ)
        report.untried = untried(report, changed);
    report.reference_hash = state_hash(reference);
    report.gpu_hash = state_hash(before);
    return report;
}

SystemRun::SystemRun(const System& system, SystemSide& gpu, const KnownOperations& known)
    : system_(system), gpu_(gpu), profile_(gpu.describe().profile), known_(known), before_(system.start),
      reference_(system.start), now_(system.start), right_(system.start), started_(system.passes.size()) {
    check_system(system);
}

SystemRun::SystemRun(const System& system, SystemSide& gpu, const KnownOperations& known, int frame, std::size_t pass)
    : SystemRun(system, gpu, known) {
    go_to(frame, pass);
}

void SystemRun::start_again() {
    before_ = now_ = right_ = system_.start;
    wrong_.clear();
    started_.assign(system_.passes.size(), {});
    gpu_.upload(system_.start.view());
    frame_ = 0;
    pass_ = 0;
}

void SystemRun::step(int frame, std::size_t pass) {
    const ItemPass& one = *system_.passes[pass];
    before_ = pass > 0 ? left_by(system_, pass - 1, before_, now_) : now_;
    if (!one.continues())
        put_right(gpu_, before_, right_, wrong_);
    gpu_.step(pass, frame);
    gpu_.read(now_);
    const std::uint8_t r = one.resource();
    if (!one.derived())
        return;
    run_pass(one, {std::as_const(before_).view(), frame}, profile_, right_[r]);
    if (!differing_items(std::as_const(right_)[r], std::as_const(now_)[r]).empty())
        wrong_.insert(r);
}

void SystemRun::go_to(int frame, std::size_t pass, const std::function<void(int)>& on_frame) {
    if (pass >= system_.passes.size())
        throw Error(fmt::format("{} has no pass {}; it has 0 to {}", system_.name, pass, system_.passes.size() - 1));
    const ItemPass& made = *system_.passes[pass];
    if (!made.runs(frame))
        throw Error(fmt::format("{}: pass {} does not run in frame {}", system_.name, made.name(), frame));
    if (std::pair(frame, pass) == std::pair(frame_, pass_))
        return;
    int f = frame_;
    std::size_t p = pass_ + 1;
    if (frame_ < 0 || std::pair(frame, pass) < std::pair(frame_, pass_)) {
        start_again();
        f = 0;
        p = 0;
    }
    for (; f <= frame; ++f, p = 0) {
        if (on_frame)
            on_frame(f);
        for (; p < system_.passes.size() && !(f == frame && p > pass); ++p) {
            if (!system_.passes[p]->runs(f))
                continue;
            step(f, p);
            if (f == frame && p == pass) {
                if (started_[p].frame == frame - 1 && frame > 0)
                    earlier_.emplace(std::move(started_[p].state));
                else
                    earlier_.reset();
            }
            if (f + 1 >= frame)
                started_[p] = {f, before_};
        }
    }
    frame_ = frame;
    pass_ = pass;
    before_view_ = before_.view();
    earlier_view_ = earlier_ ? earlier_->view() : SystemView();
    reference_ = before_;
    run_pass(made, {before_view_, frame}, profile_, reference_[made.resource()]);
    reference_view_ = std::as_const(reference_)[made.resource()];
    gpu_view_ = std::as_const(now_)[made.resource()];
}

JudgedPass SystemRun::judged() const {
    return {*system_.passes[pass_], profile_,        known_,    frame_,
            before_view_,           reference_view_, gpu_view_, earlier_ ? &earlier_view_ : nullptr};
}

std::vector<ToldValue> SystemRun::told(std::size_t item) { return told_of(gpu_, pass_, judged(), item); }

ReferenceRun::ReferenceRun(const System& system, Profile profile)
    : system_(system), profile_(std::move(profile)), state_(system.start), next_(system.start) {
    check_system(system);
}

void ReferenceRun::step(int frame) {
    for (std::size_t p = 0; p < system_.passes.size(); ++p)
        step_pass(p, frame);
}

void ReferenceRun::step_pass(std::size_t pass, int frame) {
    const ItemPass& one = *system_.passes[pass];
    if (!one.runs(frame))
        return;
    const SystemView before = state_.view();
    const PassInput in{before, frame};
    if (one.in_place(in))
        return run_pass(one, in, profile_, state_[one.resource()]);
    run_pass(one, in, profile_, next_[one.resource()]);
    state_.swap(one.resource(), next_);
}

std::uint64_t ReferenceRun::hash() const { return state_hash(state_); }

} // namespace lockstep
