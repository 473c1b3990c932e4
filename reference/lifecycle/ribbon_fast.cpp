#include "reference/lifecycle/ribbon_fast.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "reference/arithmetic.hpp"
#include "reference/lifecycle/kept_items.hpp"
#include "reference/lifecycle/ribbon_twin.hpp"
#include "reference/readings/values.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr std::size_t block_of_points = 256;

/// What each point of a block adds, and then the inclusive scan of it (Hillis and Steele 1986), as words.
template <class A> std::array<std::uint32_t, block_of_points> sums_of_block(const Host& host, const HostEmitter& of,
                                                                            const PassInput& in, std::uint32_t begin) {
    Values<A> r{A{}};
    const EmitterTwin<Values<A>> emitter(r, host, of, in);
    const Lengths<Values<A>> lengths(r, host.switches());
    const std::uint32_t alive = emitter.alive();
    std::array<Length<Values<A>>, block_of_points> sums, last;
    for (std::uint32_t k = 0; k < block_of_points; ++k)
        sums[k] =
            begin + k < alive
                ? lengths.of(
                      Particle<Values<A>>(r, host, emitter.words_of(emitter.point_slot(begin + k))).from_previous())
                : Length<Values<A>>{};
    for (std::size_t d = 1; d < block_of_points; d *= 2) {
        last = sums;
        for (std::size_t k = d; k < block_of_points; ++k)
            sums[k] = lengths.plus(last[k - d], last[k]);
    }
    std::array<std::uint32_t, block_of_points> words{};
    for (std::size_t k = 0; k < block_of_points; ++k)
        words[k] = host.switches().distance_sum == DistanceSum::fixed
                       ? sums[k].units
                       : std::bit_cast<std::uint32_t>(static_cast<float>(sums[k].real));
    return words;
}

} // namespace

void prefix_reduce_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first,
                        std::size_t last, const WritableView& after) {
    copy_items(in.before[length_buffer], first, first, last, after);
    const std::size_t alive = in.before.word({counter_buffer, counter::alive}, of.number);
    const std::size_t begin = std::max(first, of.base), end = std::min(last, of.base + std::min(alive, of.slots));
    for (std::size_t item = begin; item < end;) {
        const std::size_t place = item - of.base, in_block = place % block_of_points;
        const std::size_t some = std::min(block_of_points - in_block, end - item);
        const auto start = static_cast<std::uint32_t>(place - in_block);
        const auto words = host.settings().arithmetic == ArithmeticSwitch::exact
                               ? sums_of_block<Portable>(host, of, in, start)
                               : sums_of_block<Strict>(host, of, in, start);
        std::memcpy(after.columns[0] + item * sizeof(std::uint32_t), words.data() + in_block,
                    some * sizeof(std::uint32_t));
        item += some;
    }
}

void sort_fast(const HostEmitter& of, std::uint32_t run, std::uint32_t apart, const PassInput& in, std::size_t first,
               std::size_t last, const WritableView& after) {
    const View& before = in.before[key_buffer];
    copy_items(before, first, first, last, after);
    const std::size_t begin = std::max(first, of.first_key), end = std::min(last, of.first_key + of.keys);
    for (std::size_t item = begin; item < end; ++item) {
        const auto place = static_cast<std::uint32_t>(item - of.first_key);
        const std::uint32_t low = place & ~apart, high = place | apart;
        const auto key = [&](std::uint32_t at) {
            Key found{};
            for (std::size_t w = 0; w < found.size(); ++w)
                std::memcpy(&found[w], before.columns[w] + (of.first_key + at) * sizeof(std::uint32_t),
                            sizeof found[w]);
            return found;
        };
        const bool rises = (low & run) == 0;
        const Key a = key(low), b = key(high);
        const bool swaps = (b < a) == rises;
        const Key& kept = (place == low) == swaps ? b : a;
        for (std::size_t w = 0; w < kept.size(); ++w)
            std::memcpy(after.columns[w] + item * sizeof(std::uint32_t), &kept[w], sizeof kept[w]);
    }
}

} // namespace lockstep::lifecycle
