#include "reference/lifecycle/move_fast.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "reference/lifecycle/kept_items.hpp"
#include "reference/model/lifecycle/layout.hpp"
#include "reference/model/lifecycle/schema.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::lifecycle {
namespace {

using Words = std::array<std::uint32_t, block_size>;
using Reals = std::array<float, block_size>;

/// One of two words by masks: a choice that GCC takes for a branch keeps a loop from its vectors.
inline std::uint32_t chosen(bool first, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
    return (a & mask) | (b & ~mask);
}

/// half_value without branches.
inline float decoded(std::uint32_t code) {
    const std::uint32_t magnitude = code & 0x7fffU, sign = (code & 0x8000U) << 16U;
    const auto small =
        std::bit_cast<std::uint32_t>(static_cast<float>(static_cast<std::int32_t>(magnitude)) * 0x1p-24F);
    const std::uint32_t normal = (magnitude << 13U) + chosen(magnitude < 0x7c00U, 0x38000000U, 0x70000000U);
    return std::bit_cast<float>(chosen(magnitude < 0x400U, small, normal) | sign);
}

/// half_code without branches, to the nearest or toward zero. `zero_sign`: ~0, or ~0x8000 where zero has none.
template <bool nearest> std::uint32_t encoded(float x, std::uint32_t zero_sign) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t magnitude = bits & 0x7fffffffU, sign = (bits >> 16U) & 0x8000U;
    const std::uint32_t exponent = std::min(magnitude >> 23U, 112U);
    const bool is_small = magnitude < 0x38800000U;
    const std::uint32_t cut = chosen(is_small, std::min(126U - exponent, 31U), 13U);
    std::uint32_t whole = chosen(is_small, (magnitude & 0x7fffffU) | 0x800000U, magnitude - 0x38000000U);
    if (nearest)
        whole += (1U << (cut - 1U)) - 1U + ((whole >> cut) & 1U);
    const std::uint32_t finite = std::min(whole >> cut, 0x7bffU);
    const std::uint32_t code = chosen(magnitude < 0x7f800000U, finite, 0x7c00U) | sign;
    const std::uint32_t half = chosen(magnitude > 0x7f800000U, 0x7e00U, code);
    return half & chosen(half == 0x8000U, zero_sign, ~0U);
}

/// What is the same for all particles of a run.
struct Flight {
    float tick = 0.0F, half_tick_squared = 0.0F;
    Integration integration = Integration::semi_implicit;
    bool counts_ticks = false;
    std::uint32_t zero_sign = ~0U; ///< of encoded
};

/// Words 0 to 5 of particles of halves.
struct Block {
    alignas(64) std::array<Words, 6> w;
    alignas(64) std::array<Reals, 3> p, v, a;
};

void read(Block& b) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        b.p[0][i] = decoded(b.w[0][i] >> 16U);
        b.p[1][i] = decoded(b.w[0][i] & 0xffffU);
        b.p[2][i] = decoded(b.w[1][i] >> 16U);
        b.v[0][i] = decoded(b.w[1][i] & 0xffffU);
        b.v[1][i] = decoded(b.w[2][i] >> 16U);
        b.v[2][i] = decoded(b.w[2][i] & 0xffffU);
        b.a[0][i] = decoded(b.w[4][i] >> 16U);
        b.a[1][i] = decoded(b.w[4][i] & 0xffffU);
        b.a[2][i] = decoded(b.w[5][i] >> 16U);
    }
}

void fly(Block& b, const Flight& f) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Reals &p = b.p[axis], &v = b.v[axis];
        const Reals& a = b.a[axis];
        switch (f.integration) {
        case Integration::semi_implicit:
            LOCKSTEP_VECTOR_LOOP
            for (std::size_t i = 0; i < block_size; ++i) {
                v[i] = v[i] + a[i] * f.tick;
                p[i] = p[i] + v[i] * f.tick;
            }
            break;
        case Integration::explicit_euler:
            LOCKSTEP_VECTOR_LOOP
            for (std::size_t i = 0; i < block_size; ++i) {
                p[i] = p[i] + v[i] * f.tick;
                v[i] = v[i] + a[i] * f.tick;
            }
            break;
        case Integration::ballistic:
            LOCKSTEP_VECTOR_LOOP
            for (std::size_t i = 0; i < block_size; ++i) {
                p[i] = (p[i] + v[i] * f.tick) + a[i] * f.half_tick_squared;
                v[i] = v[i] + a[i] * f.tick;
            }
            break;
        }
    }
}

template <bool nearest> void write(Block& b, const Flight& f) {
    const std::uint32_t zero_sign = f.zero_sign;
    const auto half = [zero_sign](float x) { return encoded<nearest>(x, zero_sign); };
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        b.w[0][i] = (half(b.p[0][i]) << 16U) | half(b.p[1][i]);
        b.w[1][i] = (half(b.p[2][i]) << 16U) | half(b.v[0][i]);
        b.w[2][i] = (half(b.v[1][i]) << 16U) | half(b.v[2][i]);
    }
    if (f.counts_ticks) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < block_size; ++i)
            b.w[3][i] -= (b.w[3][i] & 0xffffU) != 0U ? 1U : 0U;
    } else {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < block_size; ++i)
            b.w[3][i] = (b.w[3][i] & 0xffff0000U) | half(decoded(b.w[3][i] & 0xffffU) - f.tick);
    }
}

LOCKSTEP_VECTOR_CLONES void step_to_nearest(Block& b, const Flight& f) {
    read(b);
    fly(b, f);
    write<true>(b, f);
}

LOCKSTEP_VECTOR_CLONES void step_toward_zero(Block& b, const Flight& f) {
    read(b);
    fly(b, f);
    write<false>(b, f);
}

/// Items first to last become those from `from` on, a tick later.
void step(const Host& host, const View& before, std::size_t from, std::size_t first, std::size_t last,
          const WritableView& after) {
    const Settings& s = host.settings();
    const Flight flight{s.tick, host.half_tick_squared(), s.switches.integration,
                        s.switches.time_code == TimeCode::ticks16,
                        s.arithmetic == ArithmeticSwitch::exact ? 0xffff7fffU : ~0U};
    Block block{};
    for (std::size_t i = first; i < last; i += block_size) {
        const std::size_t bytes = std::min(block_size, last - i) * sizeof(std::uint32_t);
        for (std::size_t w = 0; w < block.w.size(); ++w)
            std::memcpy(block.w[w].data(), before.columns[w] + (from + i - first) * sizeof(std::uint32_t), bytes);
        s.switches.half_rounding == HalfRounding::nearest_even ? step_to_nearest(block, flight)
                                                               : step_toward_zero(block, flight);
        for (std::size_t w = 0; w < block.w.size(); ++w)
            std::memcpy(after.columns[w] + i * sizeof(std::uint32_t), block.w[w].data(), bytes);
    }
    copy_items(before, from, first, last, after, block.w.size());
}

std::uint32_t count(const PassInput& in, const HostEmitter& of, std::uint8_t which) {
    return in.before.word({counter_buffer, which}, of.number);
}

std::size_t count_of_survivors(const Host& host, const HostEmitter& of, const PassInput& in) {
    return count(in, of, host.switches().compaction == Compaction::scan ? counter::survivors : counter::append);
}

} // namespace

bool nothing_moves(const Host& host, const HostEmitter& of, const PassInput& in) {
    return count_of_survivors(host, of, in) == 0 && count(in, of, counter::may_die) == 0;
}

bool has_move_fast(const Host& host, const HostEmitter& of) {
    const Switches& s = host.switches();
    return !plan_of(s.layout).floats && s.position_code == PositionCode::half &&
           s.half_rounding != HalfRounding::dithered && s.curl_use == CurlUse::force && !host.lists() &&
           of.settings().forces.empty() && !of.settings().simulation &&
           host.settings().tick >= 0x1p-20F; // so that nothing is tiny;
}

void move_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after, std::vector<std::size_t>& left) {
    const View& before = in.before[particle_buffer];
    const std::size_t survivors = count_of_survivors(host, of, in), may_die = count(in, of, counter::may_die);
    std::size_t present = count(in, of, counter::alive);
    if (host.switches().emit_when == EmitWhen::before_destroy)
        present += count(in, of, counter::emitted);
    const std::size_t begin = std::clamp(of.base, first, last),
                      rest =
                          std::clamp(of.base + survivors, begin, std::min(std::max(of.base + of.slots, begin), last)),
                      end = std::clamp(of.base + survivors + present - may_die, rest,
                                       std::min(std::max(of.base + of.slots, rest), last));
    copy_items(before, first, first, begin, after);
    for (std::size_t item = begin; item < rest; ++item)
        left.push_back(item);
    const std::size_t from = rest - survivors + may_die;
    if (rest < end && (from > before.count() || end - rest > before.count() - from)) { // counters of a wrong shader
        for (std::size_t item = rest; item < end; ++item)
            left.push_back(item);
        return copy_items(before, end, end, last, after);
    }
    if (host.switches().fuse == Fuse::fused)
        step(host, before, from, rest, end, after);
    else
        copy_items(before, from, rest, end, after);
    copy_items(before, end, end, last, after);
}

void simulate_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                   const WritableView& after) {
    const View& before = in.before[particle_buffer];
    const std::size_t begin = std::clamp(of.base, first, last),
                      most = std::min(std::max(of.base + of.slots, begin), last),
                      end = std::clamp(of.base + count(in, of, counter::alive), begin, most);
    copy_items(before, first, first, begin, after);
    step(host, before, begin, begin, end, after);
    copy_items(before, end, end, last, after);
}

namespace {

/// How many are born; those that an emitter of lists may have no slot for are of no matter.
std::size_t emitted_in(const Host& host, const HostEmitter& of, const PassInput& in) {
    const std::size_t room =
        of.settings().capacity - std::min<std::size_t>(count(in, of, counter::alive), of.settings().capacity);
    const std::size_t request = of.request(in.frame);
    return host.switches().overflow == Overflow::replace_oldest ? request : std::min(request, room);
}

} // namespace

void emit_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after, std::vector<std::size_t>& left) {
    const std::size_t begin = of.base + count(in, of, counter::alive);
    const std::size_t end = std::min(begin + emitted_in(host, of, in), of.base + of.slots);
    keep_items_but(in.before[particle_buffer], begin, end, first, last, after, left);
}

void emit_listed_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                      const WritableView& after, std::vector<std::size_t>& left) {
    const View& before = in.before[particle_buffer];
    const std::size_t alive = count(in, of, counter::alive);
    if (alive > of.slots) // of a wrong shader
        return keep_items_but(before, of.base, of.base + of.slots, first, last, after, left);
    copy_items(before, first, first, last, after);
    const std::size_t dead = of.slots - alive;
    for (std::size_t k = 0; k < std::min(dead, emitted_in(host, of, in)); ++k) {
        const std::size_t slot = in.before.word({dead_buffer, 0}, of.base + dead - 1 - k);
        if (slot < of.slots && of.base + slot >= first && of.base + slot < last)
            left.push_back(of.base + slot);
    }
}

void emit_list_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                    const WritableView& after, std::vector<std::size_t>& left) {
    const std::size_t list = 2 * of.base + (count(in, of, counter::list) & 1U) * of.slots;
    const std::size_t alive = count(in, of, counter::alive);
    const bool is_wrong = alive > of.slots;
    keep_items_but(in.before[survivor_buffer], is_wrong ? list : list + alive,
                   is_wrong ? list + of.slots : std::min(list + alive + emitted_in(host, of, in), list + of.slots),
                   first, last, after, left);
}

} // namespace lockstep::lifecycle
