#pragma once
#include <algorithm>
#include <optional>

#include "reference/text/machine_checks.hpp"

/// What invocations of a subgroup make together (GL_KHR_shader_subgroup). A subgroup's are lanes in a row.
namespace lockstep::text {

/// The lane whose value a broadcast or shuffle takes; nothing: it does not come to the step.
template <class R, int W>
std::optional<std::uint32_t> Machine<R, W>::subgroup_source(const Step& s, std::span<const Lane> peers, Lane l) {
    const std::uint32_t first = l / subgroup_size * subgroup_size, own = l - first;
    const auto given = [&] { return cell(s.b)[l].word(); };
    std::uint32_t from = 0;
    switch (s.op) {
    case spv::OpGroupNonUniformBroadcastFirst:
        return peers.front();
    case spv::OpGroupNonUniformShuffleXor:
        from = own ^ given();
        break;
    case spv::OpGroupNonUniformShuffleUp:
        from = own - given();
        break;
    case spv::OpGroupNonUniformShuffleDown:
        from = given() < subgroup_size ? own + given() : subgroup_size;
        break;
    case spv::OpGroupNonUniformQuadBroadcast:
        from = own / 4 * 4 + given();
        break;
    case spv::OpGroupNonUniformQuadSwap: // across, down, both
        from = own ^ (given() + 1);
        break;
    default: // a broadcast or shuffle
        from = given();
    }
    const bool is_here = from < subgroup_size && std::find(peers.begin(), peers.end(), first + from) != peers.end();
    return is_here ? std::optional(first + from) : std::nullopt;
}

template <class R, int W> void Machine<R, W>::subgroup_exchange(const Step& s, std::span<const Lane> peers, Lane l) {
    const std::optional<Lane> from = subgroup_source(s, peers, l);
    if (!from)
        memory_.findings().add(
            "value of an invocation that is not active in the subgroup (GL_KHR_shader_subgroup)", place(s, l),
            [&] { return fmt::format("{} of {} invocations come here", peers.size(), subgroup_size); });
    for (std::uint32_t c = 0; c < s.n; ++c) {
        cell(s.out + c)[l].set(from ? cell(s.a + c)[*from].word() : 0U);
        if (is_watched())
            unset(s.out + c)[l] = from ? unset(s.a + c)[*from] : Unset{};
    }
}

/// Of the invocations that come to the step together.
template <class R, int W> void Machine<R, W>::subgroup(const Step& s) {
    if constexpr (runs_apart<R>) {
        refuse(s, "an invocation that shares what it computes is not run apart from others");
    } else {
        if (!is_subgroup_operation(s.op))
            refuse(s, fmt::format("SPIR-V instruction {} is not interpreted", s.op));
        const bool exchanges = is_subgroup_exchange(s.op);
        for (std::uint32_t i = 0; i < count_;) { // subgroup by subgroup
            const std::uint32_t number = active_[i] / subgroup_size;
            std::uint32_t end = i + 1;
            while (end < count_ && active_[end] / subgroup_size == number)
                ++end;
            const std::span<const Lane> peers(active_.data() + i, end - i);
            for (const Lane l : peers)
                if (exchanges)
                    subgroup_exchange(s, peers, l);
                else
                    for (std::uint32_t c = 0; c < s.n; ++c)
                        cell(s.out + c)[l].set(subgroup_word(s, peers, l, c));
            i = end;
        }
    }
}

/// Follows unset values. Exchanges hand them on themselves.
template <class R, int W> void Machine<R, W>::follow_subgroup(const Step& s) {
    if (is_subgroup_exchange(s.op)) {
        if (s.op != spv::OpGroupNonUniformBroadcastFirst)
            need(s, s.b, 1);
        return;
    }
    need(s, s.a, s.d);
    if (s.op == spv::OpGroupNonUniformBallotBitExtract)
        need(s, s.b, 1);
    active([&](Lane l) {
        for (std::uint32_t c = 0; c < s.n; ++c)
            unset(s.out + c)[l] = {};
    });
}

/// Component c of what an operation other than an exchange makes for lane l.
template <class R, int W>
std::uint32_t Machine<R, W>::subgroup_word(const Step& s, std::span<const Lane> peers, Lane l, std::uint32_t c) {
    const std::uint32_t first = l / subgroup_size * subgroup_size, own = l - first;
    const auto all = [&](const auto& is) { return std::all_of(peers.begin(), peers.end(), is) ? 1U : 0U; };
    const auto is_set = [&](Lane p) { return cell(s.a)[p].word() != 0; };
    const auto bit = [&](std::uint32_t at) { return cell(s.a + at / 32)[l].word() >> at % 32 & 1U; };
    switch (s.op) {
    case spv::OpGroupNonUniformElect:
        return l == peers.front() ? 1 : 0;
    case spv::OpGroupNonUniformAll:
        return all(is_set);
    case spv::OpGroupNonUniformAny:
        return 1 - all([&](Lane p) { return !is_set(p); });
    case spv::OpGroupNonUniformAllEqual:
        return all([&](Lane p) {
            for (std::uint32_t k = 0; k < s.d; ++k) {
                const C &a = cell(s.a + k)[p], &b = cell(s.a + k)[peers.front()];
                if (s.c != 0 ? !(number(a.real()) == number(b.real())) : a.word() != b.word())
                    return false;
            }
            return true;
        });
    case spv::OpGroupNonUniformBallot: {
        std::uint32_t bits = 0;
        for (const Lane p : peers)
            if (is_set(p) && (p - first) / 32 == c)
                bits |= 1U << (p - first) % 32;
        return bits;
    }
    case spv::OpGroupNonUniformInverseBallot:
        return bit(own);
    case spv::OpGroupNonUniformBallotBitExtract: {
        const std::uint32_t index = cell(s.b)[l].word();
        return index < 128 ? bit(index) : 0;
    }
    case spv::OpGroupNonUniformBallotBitCount: {
        const std::uint32_t end = s.c == spv::GroupOperationReduce          ? subgroup_size
                                  : s.c == spv::GroupOperationInclusiveScan ? own + 1
                                                                            : own;
        std::uint32_t count = 0;
        for (std::uint32_t at = 0; at < end; ++at)
            count += bit(at);
        return count;
    }
    case spv::OpGroupNonUniformBallotFindLSB:
    case spv::OpGroupNonUniformBallotFindMSB: {
        std::uint32_t found = ~0U;
        for (std::uint32_t at = 0; at < subgroup_size; ++at)
            if (bit(at) != 0 && (found == ~0U || s.op == spv::OpGroupNonUniformBallotFindMSB))
                found = at;
        return found;
    }
    default: { // a reduction
        const std::uint32_t cluster = s.c == spv::GroupOperationClusteredReduce ? cell(s.b)[l].word() : subgroup_size;
        std::optional<std::uint32_t> made;
        for (const Lane p : peers) {
            const bool counts = s.c == spv::GroupOperationInclusiveScan   ? p <= l
                                : s.c == spv::GroupOperationExclusiveScan ? p < l
                                                                          : (p - first) / cluster == own / cluster;
            if (counts)
                made = made ? subgroup_combined(s.op, *made, cell(s.a + c)[p].word()) : cell(s.a + c)[p].word();
        }
        return made.value_or(subgroup_identity(s.op));
    }
    }
}

} // namespace lockstep::text
