#include "crosscheck/judge/system_run.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"
#include "reference/system/stored_pass.hpp"

namespace lockstep {
namespace {

/// What the GPU left, but for the buffers of passes that continue `pass`: they were not judged yet.
SystemState left_by(const System& system, std::size_t pass, const SystemState& before, const SystemState& now) {
    SystemState left = now;
    for (std::size_t p = pass + 1; p < end_of_dispatch(system, pass); ++p)
        left.take(system.passes[p]->resource(), before);
    return left;
}

std::optional<std::size_t> first_pass(const System& system, int frame) {
    for (std::size_t p = 0; p < system.passes.size(); ++p)
        if (system.passes[p]->runs(frame))
            return p;
    return {};
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

SystemRun::SystemRun(const System& system, SystemSide& gpu, const KnownOperations& known)
    : system_(system), gpu_(gpu), passes_(stored_passes(system.passes, system.schema)),
      profile_(gpu.describe().profile), known_(known), before_(system.start), reference_(system.start),
      now_(system.start), right_(system.start), started_(system.passes.size()) {
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
    const ItemPass& one = *passes_[pass];
    before_ = pass > 0 ? left_by(system_, pass - 1, before_, now_) : now_;
    if (!one.continues()) {
        put_right(gpu_, before_, right_, wrong_);
        if (end_of_dispatch(system_, pass) > pass + 1) { // passes that continue it ask what it makes of this input
            const SystemView input = before_.view();
            static_cast<void>(one.prepared({input, frame}, profile_));
        }
    }
    gpu_.step(pass, frame);
    gpu_.read(now_);
    const std::uint8_t r = one.resource();
    if (!one.derived())
        return;
    run_pass(one, before_, frame, profile_, right_);
    if (!differing_items(std::as_const(right_)[r], std::as_const(now_)[r]).empty())
        wrong_.insert(r);
}

/// What `on_frame` throws is thrown where the run stands in a frame again, the next but one at most.
void SystemRun::go_to(int frame, std::size_t pass, const std::function<void(int)>& on_frame) {
    if (pass >= system_.passes.size())
        throw Error(fmt::format("{} has no pass {}; it has 0 to {}", system_.name, pass, system_.passes.size() - 1));
    if (!passes_[pass]->runs(frame))
        throw Error(fmt::format("{}: pass {} does not run in frame {}", system_.name, passes_[pass]->name(), frame));
    if (std::pair(frame, pass) == std::pair(frame_, pass_))
        return;
    int f = frame_;
    std::size_t p = pass_ + 1;
    if (frame_ < 0 || std::pair(frame, pass) < std::pair(frame_, pass_)) {
        start_again();
        f = 0;
        p = 0;
    }
    std::exception_ptr thrown;
    for (; f <= frame; ++f, p = 0) {
        try {
            if (on_frame && !thrown)
                on_frame(f);
        } catch (...) {
            thrown = std::current_exception();
        }
        // In the frame after: what a pass started from in the frame before is kept.
        if (const auto first = first_pass(system_, f + 1); thrown && first && f + 1 < frame) {
            frame = f + 1;
            pass = *first;
        }
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
    const ItemPass& made = *passes_[pass];
    before_view_ = before_.view();
    earlier_view_ = earlier_ ? earlier_->view() : SystemView();
    reference_ = before_;
    run_pass(made, before_, frame, profile_, reference_);
    reference_view_ = std::as_const(reference_)[made.resource()];
    gpu_view_ = std::as_const(now_)[made.resource()];
    if (thrown)
        std::rethrow_exception(thrown);
}

JudgedPass SystemRun::judged() const {
    JudgedPass judged{*passes_[pass_], profile_,        known_,    frame_,
                      before_view_,    reference_view_, gpu_view_, earlier_ ? &earlier_view_ : nullptr};
    judged.text = text_of(system_, pass_);
    return judged;
}

std::vector<ToldValue> SystemRun::told(std::size_t item) { return told_of(gpu_, pass_, judged(), item); }

ReferenceRun::ReferenceRun(const System& system, Profile profile)
    : system_(system), passes_(stored_passes(system.passes, system.schema)), profile_(std::move(profile)),
      state_(system.start), next_(system.start) {
    check_system(system);
}

void ReferenceRun::step(int frame) {
    for (std::size_t p = 0; p < system_.passes.size(); ++p)
        step_pass(p, frame);
}

void ReferenceRun::step_pass(std::size_t pass, int frame) {
    const ItemPass& one = *passes_[pass];
    if (!one.runs(frame))
        return;
    const SystemView before = state_.view();
    const PassInput in{before, frame};
    if (one.in_place(in))
        return run_pass(one, in, profile_, state_.all_but(one.keeps(), one.resource()));
    run_pass(one, state_, frame, profile_, next_);
    state_.swap(one.resource(), next_);
}

std::uint64_t ReferenceRun::hash() const { return state_hash(state_); }

} // namespace lockstep
