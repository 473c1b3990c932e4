#pragma once
#include <bit>

#include "reference/text/machine_checks.hpp"

/// Copies, loads, stores, atomics and images of Machine.
namespace lockstep::text {

template <class R, int W>
std::array<std::int32_t, 3> Machine<R, W>::texel_place(std::uint32_t first, std::uint32_t count, Lane l) {
    std::array<std::int32_t, 3> at{};
    for (std::uint32_t c = 0; c < count && c < 3; ++c)
        at[c] = static_cast<std::int32_t>(cell(first + c)[l].word());
    return at;
}

/// What texture() makes of a place.
template <class R, int W> Memory::Texel Machine<R, W>::sampled(const Step& s, Lane l) {
    const std::uint32_t image = cell(s.a)[l].word();
    std::array<float, 3> place{};
    for (std::uint32_t c = 0; c < s.c && c < place.size(); ++c)
        place[c] = number(cell(s.b + c)[l].real());
    std::array<std::int32_t, 3> moved{};
    if (s.d != no_cell)
        moved = texel_place(s.d, p_.images[image].shape.axes() - (p_.images[image].shape.is_arrayed ? 1 : 0), l);
    return memory_.sample(image, place, s.c, moved);
}

/// What an atomic operation leaves where `before` was (SPIR-V 3.42.18).
template <class R, int W> std::uint32_t Machine<R, W>::changed(const Step& s, std::uint32_t before, Lane l) {
    const std::uint32_t value = cell(s.c)[l].word();
    const auto is_less = [&] { return static_cast<std::int32_t>(value) < static_cast<std::int32_t>(before); };
    switch (s.n) {
    case spv::OpAtomicLoad:
        return before;
    case spv::OpAtomicStore:
    case spv::OpAtomicExchange:
        return value;
    case spv::OpAtomicCompareExchange:
        return before == cell(s.d)[l].word() ? value : before;
    case spv::OpAtomicIIncrement:
        return before + 1;
    case spv::OpAtomicIDecrement:
        return before - 1;
    case spv::OpAtomicIAdd:
        return before + value;
    case spv::OpAtomicISub:
        return before - value;
    case spv::OpAtomicSMin:
        return is_less() ? value : before;
    case spv::OpAtomicUMin:
        return std::min(before, value);
    case spv::OpAtomicSMax:
        return is_less() ? before : value;
    case spv::OpAtomicUMax:
        return std::max(before, value);
    case spv::OpAtomicAnd:
        return before & value;
    case spv::OpAtomicOr:
        return before | value;
    case spv::OpAtomicXor:
        return before ^ value;
    default:
        refuse(s, fmt::format("SPIR-V instruction {} is not interpreted", s.n));
    }
}

template <class R, int W> void Machine<R, W>::atomic(const Step& s) {
    active([&](Lane l) {
        const Place by = place(s, l);
        if (is_watched() && s.op == code::atomic_shared && s.n != spv::OpAtomicExchange && s.n != spv::OpAtomicStore &&
            memory_.is_unset(cell(s.b)[l].word()))
            need_shared(s, cell(s.b)[l].word(), l);
        const auto change = [&](std::uint32_t before) { return changed(s, before, l); };
        const std::uint32_t before =
            s.op == code::atomic_shared ? memory_.atomic_shared(cell(s.b)[l].word(), by, change)
            : s.op == code::atomic_block
                ? memory_.atomic_block(s.a, cell(s.b)[l].word(), by, change)
                : memory_.atomic_texel(cell(s.a)[l].word(),
                                       texel_place(s.b, p_.images[cell(s.a)[l].word()].shape.axes(), l), by, change);
        if (s.out != no_cell)
            cell(s.out)[l].set(before);
    });
}

template <class R, int W> void Machine<R, W>::memory(const Step& s) {
    if constexpr (runs_apart<R>)
        if (memory_apart(s))
            return;
    switch (s.op) {
    case code::copy:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            each([&](Lane l) { assign(out[l], a[l]); });
        }
        break;
    case code::address: {
        C* const out = cell(s.out);
        each([&](Lane l) { out[l].set(s.c); });
        for (std::uint32_t k = 0; k < s.n; ++k) {
            const std::uint32_t* const term = &p_.operands[s.d + 3 * k];
            const C* const index = cell(term[0]);
            each([&](Lane l) { out[l].set(out[l].word() + index[l].word() * term[1]); });
            if (term[2] != 0 && any([&](Lane l) { return index[l].word() >= term[2]; }))
                active([&](Lane l) {
                    if (index[l].word() >= term[2]) {
                        memory_.note_index(index[l].word(), term[2], place(s, l));
                        out[l].set(out[l].word() - index[l].word() * term[1]);
                    }
                });
        }
        break;
    }
    case code::load_variable:
    case code::store_variable:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const bool loads = s.op == code::load_variable;
            const C* const offset = cell(s.b);
            C* const variable = cell(s.a + c);
            C* const value = cell((loads ? s.out : s.c) + c);
            const auto move = [&](C& part, Lane l, bool is_here) {
                if (loads)
                    assign(value[l], is_here ? part : value[l]);
                else
                    assign(part, is_here ? value[l] : part);
            };
            if (are_one(offset)) {
                C* const row = variable + std::size_t{offset[active_[0]].word()} * W;
                all([&](Lane l, bool is_here) { move(row[l], l, is_here); });
            } else {
                all([&](Lane l, bool is_here) {
                    move(variable[std::size_t{is_here ? offset[l].word() : 0} * W + l], l, is_here);
                });
            }
        }
        break;
    case code::load_shared:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            active([&](Lane l) { out[l].set(memory_.load_shared(cell(s.b)[l].word() + c, place(s, l))); });
        }
        break;
    case code::store_shared:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const C* const from = cell(s.c + c);
            active([&](Lane l) { memory_.store_shared(cell(s.b)[l].word() + c, from[l].word(), place(s, l)); });
        }
        break;
    case code::load_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const Leaf leaf = p_.leaves[s.d + c];
            const C* const offset = cell(s.b);
            const std::span<const std::uint32_t> words = is_watched() ? std::span<std::uint32_t>() : memory_.words(s.a);
            const std::uint32_t first = offset[active_[0]].word() + leaf.word;
            if (first < words.size() && are_one(offset))
                all([&](Lane l, bool is_here) { out[l].set(is_here ? words[first] : out[l].word()); });
            else if (any([&](Lane l) { return offset[l].word() + leaf.word >= words.size(); }))
                active([&](Lane l) {
                    const std::uint32_t at = offset[l].word() + leaf.word;
                    set_word(out[l], at < words.size() ? words[at] : memory_.load_block(s.a, at, place(s, l)),
                             leaf.is_real);
                });
            else
                all([&](Lane l, bool is_here) {
                    const std::uint32_t word = words[is_here ? offset[l].word() + leaf.word : 0];
                    out[l].set(is_here ? word : out[l].word());
                });
        }
        break;
    case code::store_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const C* const from = cell(s.c + c);
            const Leaf leaf = p_.leaves[s.d + c];
            const C* const offset = cell(s.b);
            const std::span<std::uint32_t> words =
                is_watched() || memory_.notes_writers() ? std::span<std::uint32_t>() : memory_.words(s.a);
            active([&](Lane l) {
                const std::uint32_t at = offset[l].word() + leaf.word;
                if (at < words.size())
                    words[at] = from[l].word();
                else
                    memory_.store_block(s.a, at, from[l].word(), place(s, l));
            });
        }
        break;
    case code::atomic_shared:
    case code::atomic_block:
    case code::atomic_texel:
        atomic(s);
        break;
    case code::array_length: {
        C* const out = cell(s.out);
        const std::uint32_t length = memory_.length(s.a);
        each([&](Lane l) { out[l].set(length); });
        break;
    }
    case code::image_size:
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                cell(s.out + c)[l].set(memory_.image(cell(s.a)[l].word()).size[c]);
        });
        break;
    case code::query_levels: {
        C* const out = cell(s.out);
        each([&](Lane l) { out[l].set(1U); });
        break;
    }
    case code::load_texel:
    case code::fetch_texel:
        active([&](Lane l) {
            std::optional<std::int32_t> level;
            if (s.op == code::fetch_texel)
                level = static_cast<std::int32_t>(cell(s.d)[l].word());
            const Memory::Texel texel =
                memory_.load_texel(cell(s.a)[l].word(), texel_place(s.b, s.c, l), level, place(s, l));
            for (std::uint32_t c = 0; c < s.n; ++c)
                cell(s.out + c)[l].set(texel[c]);
        });
        break;
    case code::store_texel:
        active([&](Lane l) {
            Memory::Texel texel{};
            for (std::uint32_t c = 0; c < s.n; ++c)
                texel[c] = cell(s.c + c)[l].word();
            memory_.store_texel(cell(s.a)[l].word(), texel_place(s.b, s.d, l), texel, place(s, l));
        });
        break;
    case code::sample_texel:
        active([&](Lane l) {
            const Memory::Texel texel = sampled(s, l);
            for (std::uint32_t c = 0; c < s.n; ++c)
                cell(s.out + c)[l].set(texel[c]);
        });
        break;
    case code::real_bits:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            each([&](Lane l) {
                if constexpr (has_sets<R>)
                    out[l].set_bits_of(a[l].real(), r);
                else
                    out[l].set(std::bit_cast<std::uint32_t>(number(a[l].real())));
            });
        }
        break;
    case code::bits_as_real:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            each([&](Lane l) {
                if constexpr (has_sets<R>)
                    if (a[l].is_open()) {
                        const std::optional<Interval> floats = word_range::floats(a[l].range());
                        return out[l].set(a[l].is_bits_of_x() ? a[l].real()
                                                              : r.between(floats.value_or(Interval::anything())));
                    }
                out[l].set(r.uniform(in_text, std::bit_cast<float>(a[l].word())));
            });
        }
        break;
    default:
        refuse(s, fmt::format("step {} is not interpreted", s.op));
    }
}

} // namespace lockstep::text
