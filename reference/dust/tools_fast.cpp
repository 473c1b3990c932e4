#include "reference/dust/tools_fast.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "reference/dust/random.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::dust {
namespace {

using Marks = std::array<std::uint32_t, block_size>;

/// Keeps every grain, then leaves those to the twin that are marked and, living or dead, of that kind.
template <class Mark> void keep_others(const Host& host, const PassInput& in, std::size_t first, std::size_t last,
                                       const WritableView& after, std::vector<std::size_t>& left, bool living,
                                       const Mark& mark_block) {
    const View& before = in.before[grain_buffer];
    const bool exact = host.settings().arithmetic == ArithmeticSwitch::exact;
    Marks marks{};
    for (; first < last; first += block_size) {
        const std::size_t count = std::min(block_size, last - first);
        mark_block(before, first, count, marks);
        std::array<std::int32_t, block_size> alive{};
        std::memcpy(alive.data(), words_at(before, field::alive, first), count * sizeof(std::int32_t));
        keep(before, first, first + count, after, exact);
        std::array<std::size_t, block_size> marked; // NOLINT: as many as there are
        std::size_t found = 0;
        for (std::size_t i = 0; i < count; ++i) { // without a branch, which nobody could foresee
            marked[found] = first + i;
            found += marks[i] & static_cast<std::uint32_t>((alive[i] == 1) == living);
        }
        left.insert(left.end(), marked.begin(), marked.begin() + static_cast<std::ptrdiff_t>(found));
    }
}

/// Whether integer numbers have a grain come back in this frame.
LOCKSTEP_VECTOR_CLONES void mark_lucky(std::uint32_t first, std::uint32_t stream, std::uint32_t* marks) {
    LOCKSTEP_VECTOR_LOOP
    for (std::uint32_t i = 0; i < block_size; ++i) {
        const std::uint32_t s = (first + i + stream) * 747796405U + 2891336453U;
        const std::uint32_t y = ((s >> ((s >> 28U) + 4U)) ^ s) * 277803737U;
        const auto number = static_cast<std::int32_t>(((y >> 22U) ^ y) >> 8U);
        marks[i] = static_cast<std::uint32_t>(static_cast<float>(number) * 0x1p-24F <= 0.01F);
    }
}

} // namespace

void reach_fast(const Host& host, const Reach& reach, const PassInput& in, std::size_t first, std::size_t last,
                const WritableView& after, std::vector<std::size_t>& left) {
    keep_others(host, in, first, last, after, left, true,
                [&](const View& before, std::size_t from, std::size_t count, Marks& marks) {
                    std::array<float, 3 * block_size> positions{};
                    std::memcpy(positions.data(), words_at(before, field::position, from), 3 * count * sizeof(float));
                    mark(reach, positions.data(), marks.data());
                });
}

Reach vacuum_reach(const Host& host, int frame) {
    const FrameValues values = host.at(frame);
    Reach reach = cone_of(values);
    if (host.switches().suction == Suction::force_kernel)
        return reach;
    reach.cosine = Reach::all_around; // death is asked for before the cone
    reach.sqr_range = std::max(reach.sqr_range, values.sqr_death_range);
    return reach;
}

Reach blast_reach(const Host& host, int frame, std::size_t ball) {
    const Explosion* explosion = host.explosion(frame, ball);
    return explosion == nullptr ? Reach{} : Reach{.centre = explosion->position, .sqr_range = explosion->sqr_range};
}

void emit_fast(const Host& host, const PassInput& in, std::size_t first, std::size_t last, const WritableView& after,
               std::vector<std::size_t>& left) {
    const bool integer = host.switches().random == Random::integer;
    const std::uint32_t seed = host.settings().seed, frame = static_cast<std::uint32_t>(in.frame);
    const std::uint32_t stream = pcg(static_cast<std::uint32_t>(Stream::chance) + pcg(frame + pcg(seed)));
    keep_others(host, in, first, last, after, left, false,
                [&](const View& /*before*/, std::size_t from, std::size_t /*count*/, Marks& marks) {
                    if (integer)
                        mark_lucky(static_cast<std::uint32_t>(from), stream, marks.data());
                    else
                        marks.fill(1);
                });
}

} // namespace lockstep::dust
