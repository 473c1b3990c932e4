#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "reference/half.hpp"
#include "reference/lights/contribution.hpp"
#include "reference/lights/light_order.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_reads.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::lights {

/// Every word 0. Twin of shaders/lights/light_volume_clear.comp.
struct ClearTwin {
    HostPtr host;
    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        const std::uint32_t before = in.before.word(field::word, item);
        const typename R::Int nothing = r.note(site::cleared, typename R::Int(0));
        words.add(r.setting(site::is_cleared, true) ? static_cast<std::uint32_t>(static_cast<int>(nothing)) : before);
        return words;
    }
    static bool fast(const FastRun& run) {
        std::memset(run.after.columns[0] + run.first * sizeof(std::uint32_t), 0,
                    (run.last - run.first) * sizeof(std::uint32_t));
        return true;
    }
};

/// A sum of integers, and the least and greatest that it may be; `any` where a shader's conversion is undefined.
struct FixedSum {
    std::int64_t value = 0, low = 0, high = 0;
    bool any = false;

    void start(std::int64_t from) { value = low = high = from; }

    /// The interval of a float, rounded by `to_fixed`, which never falls.
    template <class ToFixed> void add(float x, const Interval& set, double most, const ToFixed& to_fixed) {
        any = any || set.any || !(std::abs(set.low) < most) || !(std::abs(set.high) < most);
        if (!(std::abs(x) < most))
            return;
        value += to_fixed(double{x});
        if (!any) {
            low += to_fixed(set.low);
            high += to_fixed(set.high);
        }
    }
    /// 32 bits of it, from `shift` upwards.
    [[nodiscard]] LegalWord word(int shift) const {
        const auto part = [&](std::int64_t sum) { return static_cast<std::uint32_t>(sum >> shift); };
        LegalWord legal{part(value), Interval::anything()};
        const bool same_above = shift == 32 || (low >> 32) == (high >> 32);
        if (any)
            return legal;
        const bool in_order = same_above && part(low) <= part(high);
        legal.set = in_order ? Interval{static_cast<double>(part(low)), static_cast<double>(part(high))}
                             : Interval{0.0, 0x1p32};
        return legal;
    }
};

/// floor(x 2^32): bits under 2^-32 are cut.
inline std::int64_t to_fixed64(double x) {
    const auto cut = static_cast<std::int64_t>(x * 0x1p32);
    return cut - (static_cast<double>(cut) > x * 0x1p32 ? 1 : 0);
}

/// The place of a channel of a voxel: r g b, x y z, W.
inline const Site& channel_site(std::size_t k) {
    static constexpr std::array<const Site*, 7> all{&site::red,   &site::green, &site::blue,      &site::sum_x,
                                                    &site::sum_y, &site::sum_z, &site::sum_weight};
    return *all[k];
}

template <class R> std::size_t noted_channel(R& r, std::size_t k) {
    const typename R::Int noted = r.note(site::channel, typename R::Int(static_cast<int>(k)));
    return static_cast<std::size_t>(std::clamp(static_cast<int>(noted), 0, 6));
}

/// Calls `add` with what each light that reaches the voxel adds to it, of those that the shader tries there.
template <class R, class Add> void for_each_light(R& r, const Host& host, const SystemView& state,
                                                  const std::vector<std::uint32_t>& order, const TriedLights& tried,
                                                  const Voxel& v, const Add& add) {
    const auto point = voxel_point(r, host, v);
    const auto lights = r.range(site::all_lights, 0, static_cast<int>(order.size()) - 1);
    std::optional<int> left; // a row of cells
    tried.for_each(lights, v, [&](std::size_t k) {
        if (left == tried.row(k))
            return;
        const auto light = r.setting(site::by_cell, true) ? order[k] : static_cast<std::uint32_t>(k);
        if (const auto made = contribution(r, host, state, light, point, v))
            add(*made);
        else if (!r.setting(site::goes_on, true))
            left = tried.row(k);
    });
}

/// One word of the accumulator: a channel of a voxel. Twin of shaders/lights/light_volume_scatter.comp, whose
/// invocations are lights.
struct ScatterTwin {
    HostPtr host;
    std::vector<std::uint32_t> order = {};
    TriedLights tried = {}; ///< of them

    [[nodiscard]] ScatterTwin at(const PassInput& in) const {
        ScatterTwin made{host, light_order(*host, in.before)};
        made.tried = TriedLights(*host, in.before, made.order);
        return made;
    }
    [[nodiscard]] ScatterTwin handed(std::span<const Mistake> made) const {
        return {host, order, tried.mistaken(made)};
    }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const Accumulate how = host->switches().accumulate;
        const auto [voxel, word] = place_of(r, item);
        const Voxel v = Voxel::of(host->grid(), voxel);
        ItemWords<R> words;
        if (adds_floats(how))
            words.add(float_sum(r, in, item, v, word));
        else if (word == (how == Accumulate::fixed64 ? 14U : 7U))
            words.add(counted(r, in, item, v));
        else if (how == Accumulate::fixed64)
            words.add(fixed64_word(r, in, voxel, v, word));
        else
            words.add(fixed32_word(r, in, item, v, word));
        return words;
    }

    template <class R> bool all(R& r, const PassInput& in, const WritableView& after) const {
        std::memcpy(after.columns[0], in.before[accumulator_image].columns[0], after.count() * sizeof(std::uint32_t));
        const Words words{after, host->grid().count()};
        if (host->switches().accumulate == Accumulate::fixed64) {
            const std::size_t layer = words.voxels / static_cast<std::size_t>(host->grid().size.z);
            scatter(r, *host, in.before, order,
                    [&](std::ptrdiff_t z) { return FixedLayer(words, static_cast<std::size_t>(z) * layer, layer); });
        } else {
            scatter(r, *host, in.before, order, [&](std::ptrdiff_t) {
                return [&](std::size_t voxel, const Contribution<R>& made) { add_words(r, words, voxel, made); };
            });
        }
        return true;
    }

  private:
    /// A word of the accumulator.
    struct Place {
        std::size_t voxel, word;
    };
    template <class R> Place place_of(R& r, std::size_t item) const {
        const Grid& grid = host->grid();
        const std::size_t voxels = grid.count();
        if (r.setting(site::is_stacked, true))
            return {item % voxels, item / voxels};
        const auto words = static_cast<std::size_t>(channels(host->switches().accumulate));
        const std::size_t layer = voxels / static_cast<std::size_t>(grid.size.z), at = item / layer;
        return {at / words * layer + item % layer, at % words};
    }

    /// The accumulator's words, channel by channel.
    struct Words {
        WritableView view;
        std::size_t voxels;

        [[nodiscard]] std::uint32_t get(std::size_t voxel, std::size_t k) const {
            std::uint32_t bits = 0;
            std::memcpy(&bits, place(voxel, k), sizeof bits);
            return bits;
        }
        void put(std::size_t voxel, std::size_t k, std::uint32_t bits) const {
            std::memcpy(place(voxel, k), &bits, sizeof bits);
        }

      private:
        [[nodiscard]] std::byte* place(std::size_t voxel, std::size_t k) const {
            return view.columns[0] + (voxel + k * voxels) * sizeof(std::uint32_t);
        }
    };

    /// The sums of a layer, a voxel's side by side while they grow: in the accumulator every word is far from the next.
    class FixedLayer {
      public:
        FixedLayer(const Words& words, std::size_t first, std::size_t count)
            : words_(words), first_(first), sums_(count) {
            for (std::size_t k = 0; k < 7; ++k)
                for (std::size_t i = 0; i < count; ++i)
                    sums_[i][k] = std::uint64_t{words_.get(first + i, 2 * k + 1)} << 32U | words_.get(first + i, 2 * k);
            for (std::size_t i = 0; i < count; ++i)
                sums_[i][7] = words_.get(first + i, 14);
        }
        ~FixedLayer() {
            for (std::size_t k = 0; k < 7; ++k)
                for (std::size_t i = 0; i < sums_.size(); ++i) {
                    words_.put(first_ + i, 2 * k, static_cast<std::uint32_t>(sums_[i][k]));
                    words_.put(first_ + i, 2 * k + 1, static_cast<std::uint32_t>(sums_[i][k] >> 32U));
                }
            for (std::size_t i = 0; i < sums_.size(); ++i)
                words_.put(first_ + i, 14, static_cast<std::uint32_t>(sums_[i][7]));
        }
        FixedLayer(const FixedLayer&) = delete;
        FixedLayer& operator=(const FixedLayer&) = delete;

        template <class R> void operator()(std::size_t voxel, const Contribution<R>& made) {
            const auto channels = made.channels();
            std::array<std::uint64_t, 8>& sums = sums_[voxel - first_];
            for (std::size_t k = 0; k < channels.size(); ++k)
                if (const auto x = static_cast<float>(channels[k]); std::abs(x) < 0x1p31F)
                    sums[k] += static_cast<std::uint64_t>(to_fixed64(double{x}));
            ++sums[7];
        }

      private:
        Words words_;
        std::size_t first_;
        std::vector<std::array<std::uint64_t, 8>> sums_; ///< of each channel, and how many
    };

    [[nodiscard]] float scale() const { return std::ldexp(1.0F, host->fixed_bits()); }

    /// With the other ways to accumulate, which have a word a channel.
    template <class R> void add_words(R& r, const Words& words, std::size_t voxel, const Contribution<R>& made) const {
        const bool floats = adds_floats(host->switches().accumulate);
        const auto channels = made.channels();
        for (std::size_t k = 0; k < channels.size(); ++k) {
            const std::uint32_t before = words.get(voxel, k);
            if (floats) {
                const auto sum = typename R::Real(std::bit_cast<float>(before)) + channels[k];
                words.put(voxel, k, std::bit_cast<std::uint32_t>(static_cast<float>(sum)));
            } else {
                const auto q = static_cast<float>(r.floor(channels[k] * scale() + typename R::Real(0.5F)));
                if (std::abs(q) < 0x1p31F)
                    words.put(voxel, k, before + static_cast<std::uint32_t>(static_cast<std::int32_t>(q)));
            }
        }
        const std::uint32_t count = words.get(voxel, 7);
        words.put(voxel, 7, floats ? std::bit_cast<std::uint32_t>(std::bit_cast<float>(count) + 1.0F) : count + 1);
    }

    /// Calls `add` with what each light that reaches the voxel adds to it.
    template <class R, class Add> void for_each(R& r, const PassInput& in, const Voxel& v, const Add& add) const {
        for_each_light(r, *host, in.before, order, tried, v, add);
    }
    template <class R>
    typename R::Real float_sum(R& r, const PassInput& in, std::size_t item, const Voxel& v, std::size_t word) const {
        using Real = typename R::Real;
        std::vector<Real> terms;
        if (const float before = in.before.real(field::word, item); before != 0.0F)
            terms.push_back(r.read(site::word, before));
        for_each(r, in, v, [&](const Contribution<R>& made) {
            terms.push_back(word == 7 ? r.uniform(site::one_more, 1.0F)
                                      : r.note(channel_site(word), made.channels()[noted_channel(r, word)]));
        });
        Real sum = r.any_order_sum(site::sum, terms);
        if (host->switches().accumulate == Accumulate::racing)
            sum = unspecified_within(r, site::sum, sum, of_any_terms(terms));
        return r.note(site::sum, sum);
    }
    /// Sums of some of the terms, in any order.
    template <class Real> static Interval of_any_terms(const std::vector<Real>& terms) {
        Interval sum;
        for (const Real& term : terms) {
            const Interval set = item_twin::set_of(term);
            if (set.any)
                return Interval::anything();
            sum.low += std::min(set.low, 0.0);
            sum.high += std::max(set.high, 0.0);
        }
        // Each addition is off by half an ULP of no more than all of them.
        const double error = (sum.high - sum.low) * static_cast<double>(terms.size()) * 0x1p-23;
        return {sum.low - error, sum.high + error};
    }
    template <class R> LegalWord counted(R& r, const PassInput& in, std::size_t item, const Voxel& v) const {
        std::uint32_t count = in.before.word(field::word, item);
        for_each(r, in, v, [&](const Contribution<R>&) {
            count += static_cast<std::uint32_t>(static_cast<int>(r.uniform(site::one_more, 1)));
        });
        return LegalWord::exactly(count);
    }
    template <class R>
    LegalWord fixed64_word(R& r, const PassInput& in, std::size_t voxel, const Voxel& v, std::size_t word) const {
        const std::size_t voxels = host->grid().count(), low = voxel + (word & ~std::size_t{1}) * voxels;
        FixedSum sum;
        sum.start(static_cast<std::int64_t>(std::uint64_t{in.before.word(field::word, low + voxels)} << 32U |
                                            in.before.word(field::word, low)));
        const bool always_carries = r.setting(site::always_carries, false);
        std::uint32_t without_carries = in.before.word(field::word, low + voxels);
        for_each(r, in, v, [&](const Contribution<R>& made) {
            const auto x = r.note(channel_site(word / 2), made.channels()[noted_channel(r, word / 2)]);
            const Interval set = item_twin::set_of(x);
            const auto value = set.any ? 0.0F : set.as_float();
            const bool no_borrow = !r.setting(site::borrows, true) && value < 0.0F && value != std::floor(value);
            const bool cut = !r.setting(site::rounds_down, true);
            sum.add(value, set, 0x1p31, [&](double n) {
                return (cut ? static_cast<std::int64_t>(n * 0x1p32) : to_fixed64(n)) + (no_borrow ? 0x100000000 : 0);
            });
            if (std::abs(value) < 0x1p31F)
                without_carries +=
                    static_cast<std::uint32_t>(to_fixed64(double{value}) >> 32) + (always_carries ? 1U : 0U);
        });
        if ((!r.setting(site::carries, true) || always_carries) && word % 2 == 1)
            return LegalWord::exactly(without_carries);
        return sum.word(word % 2 == 1 ? 32 : 0);
    }
    template <class R>
    LegalWord fixed32_word(R& r, const PassInput& in, std::size_t item, const Voxel& v, std::size_t word) const {
        using Real = typename R::Real;
        FixedSum sum;
        sum.start(in.before.integer(field::word, item));
        for_each(r, in, v, [&](const Contribution<R>& made) {
            const Real x = r.note(channel_site(word), made.channels()[noted_channel(r, word)]);
            const Real units =
                r.note(site::units, x * r.uniform(site::fixed_scale, scale()) + r.uniform(site::half_unit, 0.5F));
            const Real q = r.note(site::quantum, r.floor(units));
            const Interval set = item_twin::set_of(q);
            sum.add(set.any ? 0.0F : set.as_float(), set, 0x1p31,
                    [](double n) { return static_cast<std::int64_t>(n); });
        });
        return sum.word(0);
    }
};

/// The words of a voxel as numbers, or what gathering and blending add up: (C, count) or (D, W).
enum class Texture { colour, direction };

template <class R> void add_texel(R& r, ItemWords<R>& words, Texture of, Format format, typename R::Vec4 v) {
    if (format == Format::rgba16f)
        v = {r.monotone(v.x, half_round), r.monotone(v.y, half_round), r.monotone(v.z, half_round),
             r.monotone(v.w, half_round)};
    v = r.note(of == Texture::colour ? site::volume_colour : site::volume_direction, v);
    for (const auto& part : {v.x, v.y, v.z, v.w})
        words.add(part);
}

/// Words to floats. Twin of shaders/lights/light_volume_resolve.comp.
struct ResolveTwin {
    HostPtr host;
    Texture texture;

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        const bool colour_of = r.setting(site::own_sums, true) == (texture == Texture::colour);
        ItemWords<R> words;
        const auto at = [&](std::size_t k) { return channel(r, in, item, k); };
        typename R::Vec4 v;
        if (colour_of)
            v = {at(0), at(1), at(2), counted(r, in, item)};
        else
            v = {at(3), at(4), at(5), at(6)};
        add_texel(r, words, texture, host->switches().volume_format, v);
        return words;
    }

  private:
    /// The item as many volumes further.
    template <class Item> [[nodiscard]] Item further(const Item& item, std::size_t volumes) const {
        const std::size_t voxels = volumes * host->grid().count();
        if constexpr (std::is_same_v<Item, std::size_t>)
            return item + voxels;
        else
            return {item.v + static_cast<std::int32_t>(voxels), item.count};
    }
    /// A word of a voxel.
    template <class R, class Item> [[nodiscard]] Item place_of(R& r, const Item& voxel, std::size_t k) const {
        if constexpr (!HasLanes<R>)
            if (!r.setting(site::is_stacked, true)) {
                const Grid& grid = host->grid();
                const auto words = static_cast<std::size_t>(channels(host->switches().accumulate));
                const std::size_t layer = grid.count() / static_cast<std::size_t>(grid.size.z);
                return (voxel / layer * words + k) * layer + voxel % layer;
            }
        return further(voxel, k);
    }
    template <class Item> static auto word(const PassInput& in, const Item& item) {
        if constexpr (std::is_same_v<Item, std::size_t>)
            return in.before.integer(field::word, item);
        else
            return item_int(in.before, field::word, item).v;
    }
    template <class R, class Word> static typename R::Real number(R& r, const Word& word) {
        if constexpr (HasLanes<R>)
            return r.real(IndexOf<R>(word));
        else
            return r.real(word);
    }
    template <class R, class Word> static typename R::Real whole(R& r, const Word& bits) {
        using Real = typename R::Real;
        return r.note(site::high_word, number(r, Word(bits >> 12)) * Real(4096.0F) + number(r, Word(bits & 4095)));
    }
    template <class R, class Word> static typename R::Real upper_24_bits(R& r, const Word& low) {
        if constexpr (!HasLanes<R>)
            if (!r.setting(site::low_is_cut, true))
                return r.real(static_cast<std::uint32_t>(low)) * typename R::Real(0x1p-8F);
        return number(r, Word((low >> 8) & 0xffffff));
    }
    template <class R, class Item>
    typename R::Real channel(R& r, const PassInput& in, const Item& item, std::size_t k) const {
        using Real = typename R::Real;
        const Accumulate how = host->switches().accumulate;
        Real value{};
        if constexpr (!HasLanes<R>)
            k = noted_channel(r, k);
        if (adds_floats(how)) {
            value = item_real(r, site::word, in.before, field::word, place_of(r, item, k));
        } else if (how == Accumulate::fixed64) {
            const bool in_order = r.setting(site::low_first, true);
            const auto low = word(in, place_of(r, item, in_order ? 2 * k : 2 * k + 1)),
                       high = word(in, place_of(r, item, in_order ? 2 * k + 1 : 2 * k));
            value = whole(r, high) + r.note(site::low_word, upper_24_bits(r, low)) * Real(0x1p-24F);
        } else {
            value = whole(r, word(in, place_of(r, item, k))) *
                    r.uniform(site::fixed_scale, std::ldexp(1.0F, -host->fixed_bits()));
        }
        return r.note(channel_site(k), value);
    }
    template <class R, class Item> typename R::Real counted(R& r, const PassInput& in, const Item& item) const {
        if (!r.setting(site::count_word, true))
            return channel(r, in, item, 6);
        const Accumulate how = host->switches().accumulate;
        if (adds_floats(how))
            return r.note(site::count, item_real(r, site::word, in.before, field::word, place_of(r, item, 7)));
        const auto count = word(in, place_of(r, item, how == Accumulate::fixed64 ? 14 : 7));
        if constexpr (HasLanes<R>) // a sum of two that are exact: rounded once
            return number(r, IntLanes((count >> 16) & 0xffff)) * typename R::Real(65536.0F) +
                   number(r, IntLanes(count & 0xffff));
        else
            return r.note(site::count, r.real(static_cast<std::uint32_t>(count)));
    }
};

/// A voxel's lights, added as floats in one order. Twin of shaders/lights/light_volume_gather.comp, and of
/// light_volume_blend.*, where each sum is GL's own.
struct GatherTwin {
    HostPtr host;
    Texture texture;
    std::vector<std::uint32_t> order = {};
    TriedLights tried = {}; ///< of them

    [[nodiscard]] GatherTwin at(const PassInput& in) const {
        GatherTwin made{host, texture, light_order(*host, in.before)};
        made.tried = TriedLights(*host, in.before, made.order);
        return made;
    }
    [[nodiscard]] GatherTwin handed(std::span<const Mistake> made) const {
        return {host, texture, order, tried.mistaken(made)};
    }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        Voxel v = Voxel::of(host->grid(), item);
        if (!r.setting(site::own_place, true) && host->grid().size.x == host->grid().size.z)
            std::swap(v.x, v.z);
        const bool own = r.setting(site::own_sums, true);
        const Texture other = texture == Texture::colour ? Texture::direction : Texture::colour;
        std::array<std::vector<Real>, 4> terms;
        for_each_light(r, *host, in.before, order, tried, v, [&](const Contribution<R>& made) {
            for (std::size_t c = 0; c < 4; ++c)
                terms[c].push_back(addend(r, made, own ? texture : other, c));
        });
        typename R::Vec4 sum{added(r, terms[0]), added(r, terms[1]), added(r, terms[2]), added(r, terms[3], false)};
        sum = r.note(site::sum, sum);
        ItemWords<R> words;
        add_texel(r, words, texture, stored_format(), sum);
        return words;
    }

    template <class R> bool all(R& r, const PassInput& in, const WritableView& after) const {
        using Real = typename R::Real;
        std::vector<std::array<Real, 4>> sums(host->grid().count());
        scatter(r, *host, in.before, order, [&](std::ptrdiff_t) {
            return [&](std::size_t voxel, const Contribution<R>& made) {
                for (std::size_t c = 0; c < 4; ++c)
                    sums[voxel][c] = next(sums[voxel][c], addend(r, made, texture, c));
            };
        });
        for (std::size_t voxel = 0; voxel < sums.size(); ++voxel) {
            ItemWords<R> words;
            const std::array<Real, 4>& s = sums[voxel];
            add_texel(r, words, texture, stored_format(), {s[0], s[1], s[2], s[3]});
            std::byte* to = after.columns[0] + voxel * 4 * sizeof(float);
            words.for_each([&](const auto& x) {
                const std::uint32_t word = item_twin::word_of(x);
                std::memcpy(to, &word, sizeof word);
                to += sizeof word;
            });
        }
        return true;
    }

  private:
    [[nodiscard]] bool blends_halves() const {
        return blends(host->switches().accumulate) && host->switches().volume_format == Format::rgba16f;
    }
    /// What is blended is rounded by GL, sum by sum.
    [[nodiscard]] Format stored_format() const {
        return blends_halves() ? Format::rgba32f : host->switches().volume_format;
    }
    template <class R> typename R::Real addend(R& r, const Contribution<R>& made, Texture of, std::size_t c) const {
        using Real = typename R::Real;
        if (of == Texture::colour && c == 3)
            return r.uniform(site::one_more, 1.0F);
        const std::size_t k = c + (of == Texture::direction ? 3 : 0);
        Real x = r.note(channel_site(k), made.channels()[k]);
        if (host->switches().accumulate == Accumulate::blend_exact) {
            const float scale = std::ldexp(1.0F, host->fixed_bits());
            const Real q = r.floor(x * r.uniform(site::fixed_scale, scale) + r.uniform(site::half_unit, 0.5F));
            x = r.note(site::quantum, q * Real(1.0F / scale));
        }
        return x;
    }
    template <class Real> Real next(const Real& sum, const Real& x) const {
        return blends_halves() ? Real(half_truncated(static_cast<float>(sum + x))) : sum + x;
    }
    template <class R>
    typename R::Real added(R& r, const std::vector<typename R::Real>& terms, bool is_vector = true) const {
        using Real = typename R::Real;
        if (blends_halves())
            return host->follows_driver() ? followed_halves(r, terms) : blended_halves(r, terms);
        if (blends(host->switches().accumulate) && !host->follows_driver())
            return r.any_order_sum(site::sum, terms);
        Real sum(0.0F);
        const bool adds = r.setting(site::adds, true), is_greatest = is_vector && r.setting(site::greatest, false);
        for (const Real& x : terms)
            sum = is_greatest ? r.max(sum, x) : adds ? sum + x : x;
        return sum;
    }
    /// In the order of drawing, each rounded toward zero, or each to the nearest: the value is the first of these.
    template <class R> typename R::Real followed_halves(R& r, const std::vector<typename R::Real>& terms) const {
        using Real = typename R::Real;
        Real cut(0.0F), nearest(0.0F);
        for (const Real& x : terms) {
            cut = r.monotone(cut + x, half_truncated);
            nearest = r.monotone(nearest + x, half_nearest);
        }
        const Interval one = item_twin::set_of(cut), other = item_twin::set_of(nearest);
        return r.unspecified(site::sum, cut, static_cast<float>(std::fmin(one.low, other.low)),
                             static_cast<float>(std::fmax(one.high, other.high)));
    }
    /// Rounded toward zero each, and legally to either neighbour.
    template <class R> typename R::Real blended_halves(R& r, const std::vector<typename R::Real>& terms) const {
        using Real = typename R::Real;
        float value = 0.0F, low = 0.0F, high = 0.0F;
        for (const Real& x : terms) {
            const Interval set = item_twin::set_of(x);
            const auto down = [](double sum) { return half_toward(static_cast<float>(sum), false); };
            const auto up = [](double sum) { return half_toward(static_cast<float>(sum), true); };
            low = set.any ? -HUGE_VALF : std::fmin(down(double{low} + set.low), down(double{low} + down(set.low)));
            high = set.any ? HUGE_VALF : std::fmax(up(double{high} + set.high), up(double{high} + up(set.high)));
            value = half_truncated(value + (set.any ? 0.0F : set.as_float()));
        }
        return r.unspecified(site::sum, Real(value), low, high);
    }
};

/// How many lights a cell has, and where they begin among all. Twin of shaders/lights/light_sort_pass.comp.
struct CellTwin {
    HostPtr host;
    std::shared_ptr<const SortedCells> cells = {};
    CellBy by = CellBy::place;

    [[nodiscard]] CellTwin at(const PassInput& /*in*/) const { return {host, std::make_shared<const SortedCells>()}; }
    [[nodiscard]] CellTwin handed(std::span<const Mistake> made) const { return {host, cells, sorted_by(made)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const CellLists& lists = cells->of(by, *host, in.before);
        ItemWords<R> words;
        const auto add = [&](const Site& place, std::uint32_t number) {
            const typename R::Int noted = r.note(place, typename R::Int(static_cast<int>(number)));
            words.add(static_cast<std::uint32_t>(static_cast<int>(noted)));
        };
        const std::size_t width = static_cast<std::size_t>(host->grid().size.x), row = item / width * width;
        std::uint32_t in_row = 0;
        for (std::size_t i = row; i < row + width; ++i)
            in_row += lists.counts[i];
        r.note(site::row_end, typename R::Int(static_cast<int>(lists.starts[row] + in_row)));
        add(site::cell_count, lists.counts[item]);
        add(site::cell_start, lists.starts[item]);
        return words;
    }
};

/// The light at a place of the order by cells; behind the last of them what was there.
struct SortTwin {
    HostPtr host;
    std::shared_ptr<const SortedCells> cells = {};
    CellBy by = CellBy::place;

    [[nodiscard]] SortTwin at(const PassInput& /*in*/) const { return {host, std::make_shared<const SortedCells>()}; }
    [[nodiscard]] SortTwin handed(std::span<const Mistake> made) const { return {host, cells, sorted_by(made)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const std::vector<std::uint32_t>& order = cells->of(by, *host, in.before).order;
        const std::uint32_t light = item < order.size() ? order[item] : in.before.word(field::place, item);
        const typename R::Int noted = r.note(site::sorted, typename R::Int(static_cast<int>(light)));
        ItemWords<R> words;
        words.add(static_cast<std::uint32_t>(static_cast<int>(noted)));
        return words;
    }
};

} // namespace lockstep::lights
