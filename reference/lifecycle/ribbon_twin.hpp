#pragma once
#include <algorithm>

#include "reference/lifecycle/lengths.hpp"
#include "reference/lifecycle/sort_twin.hpp"

/// The lengths along a ribbon. Twins of shaders/lifecycle/ribbon_distance.comp, prefix_reduce.comp, prefix_scan.comp
/// and prefix_sum.comp.
namespace lockstep::lifecycle {

inline constexpr FieldId distance_of_point{length_buffer, 0}, length_of_block{block_length_buffer, 0};

/// How far each point is from the one before.
struct RibbonDistanceTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t place = place_of_point(*host, *of, in, item);
        if (!emitter.has(item) || !r.decide(site::is_point, place < emitter.alive()))
            return kept(r, *host, in, item);
        Particle<R> point(r, *host, emitter.words_of(emitter.slot(item)));
        point.at(emitter.slot(item), in.frame);
        typename R::Real way(0.0F);
        if (place > 0) {
            const Particle<R> last(r, *host, emitter.words_of(emitter.point_slot(place - 1)));
            const auto between = r.note(site::between_points, point.position() - last.position());
            way = r.length(site::way_to_point, between);
        }
        point.set_from_previous(r.note(site::way_to_point, way));
        return point.record();
    }
};

/// The sums within a block of 256, at a point and of a whole block.
struct BlockLengths {
    HostPtr host;
    const HostEmitter* of;

    template <class R> Length<R> scan(R& r, const PassInput& in, std::uint32_t point) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const Lengths<R> lengths(r, host->switches());
        const std::uint32_t n = emitter.alive(), first = point & ~255U;
        return lengths.scan(point & 255U, [&](std::uint32_t k) {
            if (first + k >= n)
                return Length<R>{};
            return lengths.of(Particle<R>(r, *host, emitter.words_of(emitter.point_slot(first + k))).from_previous());
        });
    }
};

struct PrefixReduceTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const Lengths<R> lengths(r, host->switches());
        if (!emitter.has(item) || !r.decide(site::is_point, emitter.slot(item) < emitter.alive()))
            return lengths.kept(in.before, distance_of_point, item);
        return lengths.record(BlockLengths{host, of}.scan(r, in, emitter.slot(item)));
    }
};

struct BlockLengthTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const Lengths<R> lengths(r, host->switches());
        const std::uint32_t blocks = groups_of(EmitterTwin<R>(r, *host, *of, in).alive());
        if (item < of->first_block || item - of->first_block >= blocks)
            return lengths.kept(in.before, length_of_block, item);
        const auto block = static_cast<std::uint32_t>(item - of->first_block);
        return lengths.record(BlockLengths{host, of}.scan(r, in, block * 256U + 255U));
    }
};

/// The sums of the blocks up to each block, 256 at a time.
struct PrefixScanTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const Lengths<R> lengths(r, host->switches());
        const std::uint32_t blocks = groups_of(EmitterTwin<R>(r, *host, *of, in).alive());
        if (item < of->first_block || item - of->first_block >= blocks)
            return lengths.kept(in.before, length_of_block, item);
        const auto block = static_cast<std::uint32_t>(item - of->first_block);
        const auto scan = [&](std::uint32_t b) {
            return lengths.scan(b & 255U, [&](std::uint32_t k) {
                const std::uint32_t one = (b & ~255U) + k;
                return one < blocks ? lengths.read(in.before, length_of_block, of->first_block + one) : Length<R>{};
            });
        };
        Length<R> carry;
        for (std::uint32_t start = 0; start < (block & ~255U); start += 256U)
            carry = lengths.plus(carry, scan(start + 255U));
        return lengths.record(lengths.plus(carry, scan(block)));
    }
};

struct PrefixSumTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const Lengths<R> lengths(r, host->switches());
        if (!emitter.has(item) || !r.decide(site::is_point, emitter.slot(item) < emitter.alive()))
            return lengths.kept(in.before, distance_of_point, item);
        const std::uint32_t slot = emitter.slot(item);
        Length<R> sum = lengths.read(in.before, distance_of_point, item);
        if (slot >= 256)
            sum = lengths.plus(lengths.read(in.before, length_of_block, of->first_block + slot / 256 - 1), sum);
        return lengths.record(sum);
    }
};

/// Reads the sums as they are once they are whole.
struct StartDistanceTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t place = place_of_point(*host, *of, in, item);
        if (!emitter.has(item) || !r.decide(site::is_point, place < emitter.alive()))
            return kept(r, *host, in, item);
        const Lengths<R> lengths(r, host->switches());
        Particle<R> point(r, *host, emitter.words_of(emitter.slot(item)));
        point.at(emitter.slot(item), in.frame);
        point.set_from_start(r.note(site::way_from_start,
                                    lengths.distance(lengths.read(in.before, distance_of_point, of->base + place))));
        return point.record();
    }
};

} // namespace lockstep::lifecycle
