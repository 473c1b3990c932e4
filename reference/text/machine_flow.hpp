#pragma once
#include "reference/text/machine_stage.hpp"

/// Control flow of Machine: branches, calls, barriers.
namespace lockstep::text {

/// Chooses the lanes that go on: those deepest in calls, of these those at the earliest step.
template <class R, int W> void Machine<R, W>::gather() {
    constexpr std::uint32_t none = 0xffffffffU;
    std::array<std::uint32_t, W> at; // of those that run
    std::uint32_t depth = 0, alive = 0, first = none, others = none, count = 0;
    for (int l = 0; l < W; ++l) {
        const bool runs = state_[l] == State::running;
        alive += state_[l] != State::ended ? 1 : 0;
        at[l] = runs ? pc_[l] : none;
        depth = std::max(depth, runs ? depth_[l] : 0);
    }
    for (int l = 0; l < W; ++l)
        first = std::min(first, depth_[l] == depth ? at[l] : none);
    for (int l = 0; l < W; ++l) {
        here_[l] = at[l] == first && first != none ? 1 : 0;
        others = std::min(others, at[l] != first ? at[l] : none);
    }
    for (std::uint32_t l = 0; l < W; ++l) {
        active_[count] = l;
        count += here_[l];
    }
    at_ = first;
    others_at_ = others;
    count_ = count;
    if (count_ > 0)
        note_came();
    together_ = count_ == alive;
}

template <class R, int W> void Machine<R, W>::end_loop(std::string_view rule, Place at, std::string why) const {
    const std::string what =
        fmt::format("shader {}: invocation {} does not end: {}", p_.line_name(at.line), at.invocation, why);
    throw DoesNotEnd(what, rule, at, std::move(why));
}

/// Whether some way on from a step ends the invocation, or returns.
template <class R, int W> bool Machine<R, W>::can_end_from(std::uint32_t step) const {
    std::vector<std::uint8_t> known(p_.steps.size());
    std::vector<std::uint32_t> ways{step};
    const auto constant = [&](std::uint32_t cell) { return std::ranges::find(p_.constants, cell, &CellWord::cell); };
    while (!ways.empty()) {
        std::uint32_t at = ways.back();
        ways.pop_back();
        for (bool goes_on = true; goes_on && at < p_.steps.size() && known[at] == 0; ++at) {
            known[at] = 1;
            const Step& s = p_.steps[at];
            switch (s.op) {
            case code::finish:
            case code::discard:
                return true;
            case code::jump:
                goes_on = false;
                [[fallthrough]];
            case code::call:
                ways.push_back(s.a);
                break;
            case code::branch: {
                const auto fixed = constant(s.a);
                if (fixed == p_.constants.end() || fixed->word != 0)
                    ways.push_back(s.b);
                if (fixed == p_.constants.end() || fixed->word == 0)
                    ways.push_back(s.c);
                goes_on = false;
                break;
            }
            case code::choose:
                ways.push_back(s.b);
                for (std::uint32_t k = 0; k < s.n; ++k)
                    ways.push_back(p_.operands[s.d + 2 * k + 1]);
                goes_on = false;
                break;
            default:
                break;
            }
        }
    }
    return false;
}

/// Ends a run that has come to a state for the second time, since it will again, or that has no way out of where it is.
/// The state that is compared is another from time to time (Brent's algorithm).
template <class R, int W> void Machine<R, W>::look(std::uint32_t step) {
    const Place here{p_.lines[at_ - 1], invocations_[active_[0]].number};
    if (jumps_ > most_jumps_)
        end_loop(endless_rule, here, fmt::format("no end within {} branches", most_jumps_));
    if constexpr (!runs_apart<R>) {
        const std::span<const Lane> active(active_.data(), count_);
        if (seen_.step == step && seen_.changes == memory_.changes() && std::ranges::equal(seen_.active, active) &&
            seen_.pc == pc_ && seen_.from == from_ && seen_.depth == depth_ && seen_.state == state_ &&
            seen_.returns == returns_ && std::ranges::equal(seen_.cells, cells_, {}, &C::w, &C::w)) {
            if (seen_.reads != memory_.reads())
                end_loop(waiting_rule, memory_.last_read(),
                         "what it reads would have to be written by an invocation that need not run meanwhile");
            end_loop(endless_rule, here, "it comes back to the same state");
        }
        if (jumps_ == looks_from_ + 1 || jumps_ >= 2 * seen_at_) {
            if (depth_[active_[0]] == 0 && !can_end_from(step))
                end_loop(endless_rule, here, "there is no way out of the loop");
            seen_at_ = jumps_;
            seen_ = {step,   memory_.changes(), memory_.reads(), {active.begin(), active.end()}, state_, pc_, from_,
                     depth_, returns_,          cells_};
        }
    }
}

template <class R, int W> void Machine<R, W>::go_to(std::uint32_t step) {
    if (++jumps_ > looks_from_)
        look(step);
    if (together_ || step < others_at_) {
        at_ = step;
        note_came();
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
    if (!runs_apart<R> && !is_watched()) {
        std::size_t words = 0;
        for (const Step& phi : all)
            words += std::size_t{phi.n} * W;
        moved_.resize(std::max(moved_.size(), words));
        C* to = moved_.data();
        for (const Step& phi : all)
            for (std::uint32_t c = 0; c < phi.n; ++c, to += W)
                for (std::uint32_t k = 0; k < phi.a; ++k) {
                    const std::uint32_t block = p_.operands[phi.d + 2 * k];
                    const C* const from = cell(p_.operands[phi.d + 2 * k + 1] + c);
                    this->all([&](Lane l, bool) { assign(to[l], from_[l] == block ? from[l] : to[l]); });
                }
        const C* made = moved_.data();
        for (const Step& phi : all)
            for (std::uint32_t c = 0; c < phi.n; ++c, made += W) {
                C* const out = cell(phi.out + c);
                this->all([&](Lane l, bool is_here) { assign(out[l], is_here ? made[l] : out[l]); });
            }
        at_ += s.b;
        return;
    }
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

/// Which of the pairs of a switch; their count: its default.
template <class R, int W> std::uint32_t Machine<R, W>::case_of(const Step& s, std::uint32_t chosen) const {
    std::uint32_t k = 0;
    while (k < s.n && p_.operands[s.d + 2 * k] != chosen)
        ++k;
    return k;
}

/// Of a branch or a switch, those that the lanes at this step are about to take.
template <class R, int W> void Machine<R, W>::note_ways(const Step& s) {
    const C* chosen = cell(s.a);
    std::uint8_t& ways = coverage->ways[static_cast<std::size_t>(&s - p_.steps.data())];
    constexpr std::uint8_t both = Coverage::was_true | Coverage::was_false;
    if ((ways & both) == both)
        return;
    active([&](Lane l) {
        if (s.op == code::branch)
            ways |= chosen[l].word() != 0 ? Coverage::was_true : Coverage::was_false;
        else if (const std::uint32_t k = case_of(s, chosen[l].word()); k < s.n)
            coverage->cases[s.d + 2 * k] = 1;
        else
            ways |= Coverage::was_default;
    });
}

template <class R, int W> void Machine<R, W>::flow(const Step& s) {
    if (coverage != nullptr && (s.op == code::branch || s.op == code::choose))
        note_ways(s);
    switch (s.op) {
    case code::jump:
        go_to(s.a);
        break;
    case code::branch: {
        const C* const condition = cell(s.a);
        if (!any([&](Lane l) { return condition[l].word() != 0; })) {
            go_to(s.c);
        } else if (!any([&](Lane l) { return condition[l].word() == 0; })) {
            go_to(s.b);
        } else {
            active([&](Lane l) { pc_[l] = condition[l].word() != 0 ? s.b : s.c; });
            gather();
        }
        break;
    }
    case code::choose: {
        const C* chosen = cell(s.a);
        go_each([&](Lane l) {
            const std::uint32_t k = case_of(s, chosen[l].word());
            return k < s.n ? p_.operands[s.d + 2 * k + 1] : s.b;
        });
        break;
    }
    case code::leave_block:
        active([&](Lane l) { from_[l] = s.a; });
        break;
    case code::from_block:
        take_from_blocks(s);
        break;
    case code::call: {
        std::size_t deepest = 0;
        for (int l = 0; l < W; ++l)
            deepest = std::max<std::size_t>(deepest, here_[l] * depth_[l]);
        returns_.resize(std::max(returns_.size(), (deepest + 1) * W));
        std::uint32_t* const returns = returns_.data();
        all([&](Lane l, bool is_here) {
            std::uint32_t& to = returns[std::size_t{is_here ? depth_[l] : 0} * W + l];
            to = is_here ? at_ : to;
            depth_[l] += is_here ? 1 : 0;
        });
        go_to(s.a);
        break;
    }
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
            const std::uint32_t* const returns = returns_.data();
            all([&](Lane l, bool is_here) {
                depth_[l] -= is_here ? 1 : 0;
                pc_[l] = is_here ? returns[std::size_t{is_here ? depth_[l] : 0} * W + l] : pc_[l];
            });
            others_at_ = 0; // those may be deeper
            const std::uint32_t first = pc_[active_[0]];
            if (any([&](Lane l) { return pc_[l] != first; }))
                gather();
            else
                go_to(first);
        }
        break;
    }
    case code::fence:
        if (memory_.races() != nullptr)
            active([&](Lane l) { memory_.races()->fence(s.a, invocations_[l].number); });
        break;
    default: // a barrier
        if constexpr (runs_apart<R>) {
            if (!others_)
                refuse(s, "an invocation that shares what it computes is not run apart from others");
            if (others_())
                break;
            state_[0] = State::ended;
        } else {
            active([&](Lane l) {
                state_[l] = State::waiting;
                pc_[l] = at_;
            });
        }
        gather();
    }
}

} // namespace lockstep::text
