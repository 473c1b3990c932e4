#pragma once
#include "reference/text/machine_stage.hpp"

/// Control flow of Machine: branches, calls, barriers.
namespace lockstep::text {

/// Chooses the lanes that go on: those deepest in calls, of these those at the earliest step.
template <class R, int W> void Machine<R, W>::gather() {
    std::uint32_t best = W, alive = 0;
    for (std::uint32_t l = 0; l < lanes_; ++l) {
        alive += state_[l] != State::ended ? 1 : 0;
        if (state_[l] == State::running &&
            (best == W || depth_[l] > depth_[best] || (depth_[l] == depth_[best] && pc_[l] < pc_[best])))
            best = l;
    }
    count_ = 0;
    if (best == W)
        return;
    at_ = pc_[best];
    for (std::uint32_t l = 0; l < lanes_; ++l)
        if (state_[l] == State::running && pc_[l] == at_)
            active_[count_++] = l;
    together_ = count_ == alive;
}

template <class R, int W> void Machine<R, W>::go_to(std::uint32_t step) {
    if (++jumps_ > most_jumps_) {
        const Place place{p_.lines[at_ - 1], invocations_[active_[0]].number};
        throw DoesNotEnd(fmt::format("shader {}: invocation {} does not end within {} branches",
                                     p_.line_name(place.line), place.invocation, most_jumps_),
                         place);
    }
    if (together_) {
        at_ = step;
        return;
    }
    active([&](Lane l) { pc_[l] = step; });
    gather();
}

/// Each active lane l goes on at to(l).
template <class R, int W> template <class To> void Machine<R, W>::go_each(const To& to) {
    const std::uint32_t first = to(active_[0]);
    bool is_one = true;
    active([&](Lane l) {
        pc_[l] = to(l);
        is_one = is_one && pc_[l] == first;
    });
    if (is_one)
        go_to(first);
    else
        gather();
}

/// All OpPhi of a block at once: one may take what another was.
template <class R, int W> void Machine<R, W>::take_from_blocks(const Step& s) {
    const std::span<const Step> all(&s, s.b + 1U);
    moved_.clear();
    moved_unset_.clear();
    moved_made_by_.clear();
    active([&](Lane l) {
        for (const Step& phi : all)
            for (std::uint32_t k = 0; k < phi.a; ++k)
                if (p_.operands[phi.d + 2 * k] == from_[l]) {
                    for (std::uint32_t c = 0; c < phi.n; ++c) {
                        moved_.push_back(cell(p_.operands[phi.d + 2 * k + 1] + c)[l]);
                        if (is_watched())
                            moved_unset_.push_back(unset(p_.operands[phi.d + 2 * k + 1] + c)[l]);
                        if constexpr (is_traced<R>)
                            moved_made_by_.push_back(made_by_[p_.operands[phi.d + 2 * k + 1] + c]);
                    }
                    break;
                }
    });
    std::size_t next = 0;
    active([&](Lane l) {
        for (const Step& phi : all)
            for (std::uint32_t c = 0; c < phi.n; ++c, ++next) {
                cell(phi.out + c)[l] = moved_[next];
                if (is_watched())
                    unset(phi.out + c)[l] = moved_unset_[next];
                if constexpr (is_traced<R>)
                    made_by_[phi.out + c] = moved_made_by_[next];
            }
    });
    at_ += s.b;
}

template <class R, int W> void Machine<R, W>::flow(const Step& s) {
    switch (s.op) {
    case code::jump:
        go_to(s.a);
        break;
    case code::branch: {
        const C* condition = cell(s.a);
        go_each([&](Lane l) { return condition[l].word() != 0 ? s.b : s.c; });
        break;
    }
    case code::choose: {
        const C* chosen = cell(s.a);
        go_each([&](Lane l) {
            for (std::uint32_t k = 0; k < s.n; ++k)
                if (p_.operands[s.d + 2 * k] == chosen[l].word())
                    return p_.operands[s.d + 2 * k + 1];
            return s.b;
        });
        break;
    }
    case code::leave_block:
        active([&](Lane l) { from_[l] = s.a; });
        break;
    case code::from_block:
        take_from_blocks(s);
        break;
    case code::call:
        active([&](Lane l) {
            if (returns_.size() <= std::size_t{depth_[l]} * W)
                returns_.resize((std::size_t{depth_[l]} + 1) * W);
            returns_[std::size_t{depth_[l]++} * W + l] = at_;
        });
        go_to(s.a);
        break;
    case code::finish: {
        bool ends = false;
        active([&](Lane l) {
            if (depth_[l] == 0) {
                state_[l] = State::ended, ends = true;
                if (p_.stage != spv::ExecutionModelGeometry && p_.stage != spv::ExecutionModelGLCompute)
                    make(s, l);
            }
        });
        if (ends) {
            active([&](Lane l) {
                if (depth_[l] > 0)
                    pc_[l] = returns_[std::size_t{--depth_[l]} * W + l];
            });
            gather();
        } else {
            active([&](Lane l) { --depth_[l]; });
            go_each([&](Lane l) { return returns_[std::size_t{depth_[l]} * W + l]; });
        }
        break;
    }
    case code::fence:
        if (memory_.races() != nullptr)
            active([&](Lane l) { memory_.races()->fence(s.a, invocations_[l].number); });
        break;
    default: // a barrier
        if constexpr (runs_apart<R>)
            refuse(s, "an invocation that shares what it computes is not run apart from others");
        active([&](Lane l) {
            state_[l] = State::waiting;
            pc_[l] = at_;
        });
        gather();
    }
}

} // namespace lockstep::text
