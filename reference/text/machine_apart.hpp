#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "reference/text/machine_memory.hpp"

/// Loads and stores of a Machine that runs one invocation apart from others: what it wrote is beside memory, which
/// stays as it is, so that the invocation can be run again.
namespace lockstep::text {

template <class R, int W> WrittenPlace Machine<R, W>::atomic_place(const Step& s) {
    using Space = WrittenPlace::Space;
    const bool is_done = others_ && !has_sets<R>; // else what it makes is not known
    if (s.op == code::atomic_shared)
        return {is_done ? Space::shared : Space::changed_shared, 0, cell(s.b)->word()};
    if (s.op == code::atomic_block)
        return {is_done ? Space::block : Space::changed_block, s.a, cell(s.b)->word()};
    const std::uint32_t image = cell(s.a)->word();
    return {is_done ? Space::texel : Space::changed_texel, image,
            first_word(memory_.image(image), texel_place(s.b, p_.images[image].shape.axes(), 0))};
}

/// What a texel's float may be: GL leaves the last bits of a code's open (GL 4.6, 2.3.5), and drivers take its product
/// with 1/255.
inline Interval texel_set(const TexelMemory& image, float x) {
    constexpr double two_ulps = 0x1p-22;
    const double real = x;
    return image.code == TexelMemory::Code::unorm8 && real > 0.0 && real < 1.0
               ? Interval(real * (1.0 - two_ulps), real * (1.0 + two_ulps))
               : Interval(x);
}

/// What texture() makes of a place that is a set: each texel that it may lie in is a way, and between texels its
/// weights are sets. Returns false where the place is known, or is no plane's or volume's.
template <class R, int W> bool Machine<R, W>::sample_open(const Step& s) requires has_sets<R> {
    const std::uint32_t image = cell(s.a)->word(), axes = s.c;
    const TexelMemory& of = memory_.image(image);
    const ImageShape& shape = p_.images[image].shape;
    bool is_open = false;
    for (std::uint32_t c = 0; c < axes; ++c)
        is_open = is_open || !cell(s.b + c)->real().set().is_point();
    if (!is_open || shape.is_arrayed || shape.dimensions == spv::DimCube || axes > 3)
        return false;
    const bool is_linear = of.filter != TexelMemory::Filter::nearest;
    std::array<std::int32_t, 3> base{};
    if (s.d != no_cell)
        base = texel_place(s.d, axes, 0);
    std::array<Interval, 3> behind{};
    for (std::uint32_t axis = 0; axis < axes; ++axis) {
        const auto& place = cell(s.b + axis)->real();
        const Interval x = place.set();
        if (x.any || std::isnan(x.low))
            r.end(x.any ? place.why() : Undefined::not_a_number);
        const double size = of.size[axis], half = is_linear ? 0.5 : 0.0;
        const double rounding = x.is_point() ? 0.0 : interval::ulp(std::max(std::abs(x.low), std::abs(x.high)) * size);
        const double low = std::clamp(x.low * size - half - rounding, -1.0, size),
                     high = std::clamp(x.high * size - half + rounding, -1.0, size);
        const auto chosen = r.choose(static_cast<int>(std::floor(low)), static_cast<int>(std::floor(high)));
        base[axis] += chosen;
        behind[axis] = {std::clamp(low - chosen, 0.0, 1.0), std::clamp(high - chosen, 0.0, 1.0)};
    }
    const auto texel_at = [&](std::uint32_t corner) {
        std::array<std::int32_t, 3> at = base;
        for (std::uint32_t axis = 0; axis < axes; ++axis)
            at[axis] += static_cast<std::int32_t>(corner >> axis & 1U);
        return memory_.texel_at_edge(image, at);
    };
    const std::uint32_t corners = is_linear ? 1U << axes : 1U;
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C& out = *cell(s.out + c);
        if (!p_.images[image].is_real) {
            out.set(texel_at(0)[c]);
            continue;
        }
        std::array<Interval, 8> between{};
        for (std::uint32_t k = 0; k < corners; ++k)
            between[k] = texel_set(of, std::bit_cast<float>(texel_at(k)[c]));
        for (std::uint32_t axis = 0, left = corners / 2; left > 0; ++axis, left /= 2)
            for (std::uint32_t k = 0; k < left; ++k) {
                const Interval a = between[2 * k], b = between[2 * k + 1], step = interval::add(b, interval::negate(a));
                const Interval sum = interval::add(a, interval::multiply(behind[axis], step));
                const double ulp =
                    step.any ? 0.0
                             : interval::ulp(std::max({std::abs(a.low), std::abs(a.high), std::abs(b.low),
                                                       std::abs(b.high), std::abs(step.low), std::abs(step.high)}));
                between[k] = sum.any ? sum : Interval(sum.low - ulp, sum.high + ulp);
            }
        out.set(r.between(corners == 1 ? between[0] : interval::to_floats(between[0])));
    }
    return true;
}

/// Returns false for steps that are the same in every reading.
template <class R, int W> bool Machine<R, W>::memory_apart(const Step& s) {
    static_assert(W == 1);
    using Space = WrittenPlace::Space;
    const auto word_at = [&](std::uint32_t number) { return cell(number)->word(); };
    const auto found = [&](const WrittenPlace& place) -> const C* {
        const auto at = written_->find(place);
        return at != written_->end() ? &at->second : nullptr;
    };
    const auto set_read = [&](C& out, std::uint32_t word, bool is_real) {
        if constexpr (has_sets<R>)
            if (is_real)
                return out.set(r.read(in_text, std::bit_cast<float>(word)));
        out.set(word);
    };
    const auto set_found = [&](C& out, const GroupWord& found, bool is_real) {
        if constexpr (has_sets<R>) {
            if (found.is_one_word())
                return set_read(out, found.words.first, is_real);
            if (is_real)
                return out.set(found.undefined != Undefined::none ? r.anything(found.undefined)
                               : found.set                        ? r.between(*found.set)
                                           : r.between(word_range::floats(found.words).value_or(Interval::anything())));
            if (found.set)
                return out.set_bits_of(r.between(*found.set), r);
            out.set(found.undefined != Undefined::none ? WordRange{0, ~std::uint32_t{0}} : found.words, r);
        }
    };
    const auto of_others = [&](const WrittenPlace& place) -> const GroupWord* {
        return of_others_ ? of_others_(place) : nullptr;
    };
    const auto read_texel = [&](C& out, std::uint32_t word, std::uint32_t image) {
        const bool is_real = p_.images[image].is_real;
        if constexpr (has_sets<R>)
            if (const Interval set = texel_set(memory_.image(image), std::bit_cast<float>(word));
                is_real && !set.is_point())
                return out.set(r.between(set));
        set_read(out, word, is_real);
    };
    const auto refuse_shared = [&] {
        refuse(s, "an invocation that shares what it computes is not run apart from others");
    };
    const auto write = [&](const WrittenPlace& place, const C& value, [[maybe_unused]] bool is_real) {
        C& to = (*written_)[place];
        to = value;
        if constexpr (has_sets<R>)
            to.is_real = is_real || value.is_bits_of_x();
    };
    const auto change = [&](const WrittenPlace& place, Space stored) {
        if (found({stored, place.number, place.word}) != nullptr)
            refuse_shared();
        const bool has_operand = s.n != spv::OpAtomicIIncrement && s.n != spv::OpAtomicIDecrement;
        if constexpr (has_sets<R>)
            // Of shared words what many make of open ones is known, where their order says nothing.
            if (place.space == Space::changed_shared && has_operand) {
                const C& given = *cell(s.c);
                const WordRange one = given.is_open() ? given.range() : WordRange{given.w, 0};
                if (word_range::of_atomic(s.n, one, one)) {
                    const auto [all, is_first] = written_->try_emplace({place.space, s.n, place.word});
                    const std::optional<WordRange> together =
                        is_first ? one : word_range::of_atomic(s.n, all->second.range(), one);
                    if (!together)
                        refuse_shared();
                    all->second.set(*together, r);
                    return;
                }
            }
        C& operands = (*written_)[place];
        operands.set(31 * operands.word() + (has_operand ? word_at(s.c) : 1U));
    };
    const auto texel = [&](std::uint32_t image, std::uint32_t first,
                           std::uint32_t axes) -> std::optional<std::uint64_t> {
        const std::array<std::int32_t, 3> at = texel_place(first, axes, 0);
        const TexelMemory& of = memory_.image(image);
        return is_inside(of, at) ? std::optional<std::uint64_t>(first_word(of, at)) : std::nullopt;
    };
    switch (s.op) {
    case code::load_shared:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const WrittenPlace at{Space::shared, 0, word_at(s.b) + c};
            for (const std::uint32_t op :
                 {0U, std::uint32_t{spv::OpAtomicIAdd}, std::uint32_t{spv::OpAtomicSMin},
                  std::uint32_t{spv::OpAtomicUMin}, std::uint32_t{spv::OpAtomicSMax}, std::uint32_t{spv::OpAtomicUMax}})
                if (found({Space::changed_shared, op, at.word}) != nullptr)
                    refuse_shared();
            if (const C* const own = found(at))
                *cell(s.out + c) = *own;
            else if (const GroupWord* const other = of_others(at))
                set_found(*cell(s.out + c), *other, p_.leaves[s.d + c].is_real);
            else if constexpr (has_sets<R>)
                set_read(*cell(s.out + c), 0, p_.leaves[s.d + c].is_real);
            else
                cell(s.out + c)->set(memory_.load_shared(word_at(s.b) + c, place(s, 0)));
        }
        return true;
    case code::store_shared:
        for (std::uint32_t c = 0; c < s.n; ++c)
            write({Space::shared, 0, word_at(s.b) + c}, *cell(s.c + c), p_.leaves[s.d + c].is_real);
        return true;
    case code::load_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const Leaf leaf = p_.leaves[s.d + c];
            const std::uint32_t at = word_at(s.b) + leaf.word;
            const std::span<const std::uint32_t> words = memory_.words(s.a);
            if (found({Space::changed_block, s.a, at}) != nullptr)
                refuse_shared();
            if (const C* const own = found({Space::block, s.a, at}))
                *cell(s.out + c) = *own;
            else if (const GroupWord* const other = of_others({Space::block, s.a, at}))
                set_found(*cell(s.out + c), *other, leaf.is_real);
            else
                set_read(*cell(s.out + c), at < words.size() ? words[at] : 0U, leaf.is_real);
        }
        return true;
    case code::store_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const Leaf leaf = p_.leaves[s.d + c];
            const std::uint32_t at = word_at(s.b) + leaf.word;
            if (at >= memory_.words(s.a).size())
                continue;
            if (found({Space::changed_block, s.a, at}) != nullptr)
                refuse_shared();
            write({Space::block, s.a, at}, *cell(s.c + c), leaf.is_real);
        }
        return true;
    case code::load_texel:
    case code::fetch_texel: {
        const std::uint32_t image = word_at(s.a);
        const std::optional<std::uint64_t> at = texel(image, s.b, s.c);
        std::optional<std::int32_t> level;
        if (s.op == code::fetch_texel)
            level = static_cast<std::int32_t>(word_at(s.d));
        const Memory::Texel base = memory_.load_texel(image, texel_place(s.b, s.c, 0), level, place(s, 0));
        for (std::uint32_t c = 0; c < s.n; ++c) {
            if (at && found({Space::changed_texel, image, *at + c}) != nullptr)
                refuse_shared();
            const C* const own = at ? found({Space::texel, image, *at + c}) : nullptr;
            const GroupWord* const other = at && own == nullptr ? of_others({Space::texel, image, *at + c}) : nullptr;
            if ((own != nullptr || other != nullptr) && memory_.image(image).code != TexelMemory::Code::number)
                refuse(s,
                       "an invocation that reads what it wrote of a half or rgba8 image is not run apart from others");
            if (own != nullptr)
                *cell(s.out + c) = *own;
            else if (other != nullptr)
                set_found(*cell(s.out + c), *other, p_.images[image].is_real);
            else
                read_texel(*cell(s.out + c), base[c], image);
        }
        return true;
    }
    case code::store_texel: {
        const std::uint32_t image = word_at(s.a);
        if (const std::optional<std::uint64_t> at = texel(image, s.b, s.d))
            for (std::uint32_t c = 0; c < s.n && c < memory_.image(image).components; ++c) {
                if (found({Space::changed_texel, image, *at + c}) != nullptr)
                    refuse_shared();
                write({Space::texel, image, *at + c}, *cell(s.c + c), p_.images[image].is_real);
            }
        return true;
    }
    case code::sample_texel: {
        if constexpr (has_sets<R>)
            if (sample_open(s))
                return true;
        const Memory::Texel sample = sampled(s, 0);
        for (std::uint32_t c = 0; c < s.n; ++c)
            read_texel(*cell(s.out + c), sample[c], word_at(s.a));
        return true;
    }
    case code::atomic_shared:
    case code::atomic_block:
    case code::atomic_texel: {
        if constexpr (!has_sets<R>)
            if (others_) {
                const WrittenPlace at = atomic_place(s);
                const std::span<const std::uint32_t> words = at.space == Space::block   ? memory_.words(at.number)
                                                             : at.space == Space::texel ? memory_.image(at.number).words
                                                                                        : std::span<std::uint32_t>();
                const C* const own = found(at);
                const std::uint32_t before = own != nullptr ? own->word()
                                             : at.space == Space::shared
                                                 ? memory_.load_shared(word_at(s.b), place(s, 0))
                                             : at.word < words.size() ? words[at.word]
                                                                      : 0U;
                (*written_)[at].set(changed(s, before, 0));
                if (s.out != no_cell)
                    cell(s.out)->set(before);
                return true;
            }
        if (s.out != no_cell || (s.op == code::atomic_shared && !others_))
            refuse_shared();
        const bool is_inside_memory = s.op == code::atomic_shared ? word_at(s.b) < p_.shared
                                      : s.op == code::atomic_block
                                          ? word_at(s.b) < memory_.words(s.a).size()
                                          : texel(word_at(s.a), s.b, p_.images[word_at(s.a)].shape.axes()).has_value();
        if (is_inside_memory)
            change(atomic_place(s), s.op == code::atomic_shared  ? Space::shared
                                    : s.op == code::atomic_block ? Space::block
                                                                 : Space::texel);
        return true;
    }
    default:
        return false;
    }
}

} // namespace lockstep::text
