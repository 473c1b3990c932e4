#include "reference/dust/fast_blocks.hpp"

#include <cmath>
#include <cstring>

#include "reference/portable.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::dust {
namespace {

/// More than any rounding of the twin: a distance's is 2^-21 of it, a cosine's likewise.
constexpr float margin = 1e-3F;
/// Squares this small may have been flushed, and lengths to which these belong.
constexpr float tiny_square = 1e-30F, tiny_length = 1e-15F;

LOCKSTEP_VECTOR_CLONES void mark_within(const Reach& reach, const float* positions, std::uint32_t* marks) {
    const float cx = reach.centre.x, cy = reach.centre.y, cz = reach.centre.z;
    const float ax = reach.axis.x, ay = reach.axis.y, az = reach.axis.z;
    const float farthest = reach.sqr_range * (1.0F + margin) + tiny_square, cosine = reach.cosine - margin;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        const float x = positions[3 * i] - cx, y = positions[3 * i + 1] - cy, z = positions[3 * i + 2] - cz;
        const float d2 = (x * x + y * y) + z * z;
        const float along = (x * ax + y * ay) + z * az;
        marks[i] = 1U - (static_cast<std::uint32_t>(d2 > farthest) |
                         static_cast<std::uint32_t>(along < cosine * std::sqrt(d2) - tiny_length));
    }
}

void copy_floats(const View& before, FieldId field, std::size_t first, std::size_t last, const WritableView& after,
                 bool flushed) {
    const auto* from = words_at(before, field, first);
    auto* to = words_at(after, field, first);
    const std::size_t words = 3 * (last - first);
    if (from != to)
        std::memcpy(to, from, words * sizeof(float));
    if (!flushed)
        return;
    for (std::size_t w = 0; w < words; ++w) {
        float x = 0.0F;
        std::memcpy(&x, to + w * sizeof x, sizeof x);
        x = Portable::flush(x);
        std::memcpy(to + w * sizeof x, &x, sizeof x);
    }
}

} // namespace

void keep(const View& before, std::size_t first, std::size_t last, const WritableView& after, bool exact) {
    for (const FieldId field : {field::position, field::velocity, field::colour})
        if (has(after, field))
            copy_floats(before, field, first, last, after, exact);
    const auto* alive = words_at(before, field::alive, first);
    if (has(after, field::alive) && alive != words_at(after, field::alive, first))
        std::memcpy(words_at(after, field::alive, first), alive, (last - first) * sizeof(std::int32_t));
}

Reach cone_of(const FrameValues& values) {
    return {values.controller_pos, values.controller_forward, values.sqr_range, values.threshold};
}

void mark(const Reach& reach, const float* positions, std::uint32_t* marks) { mark_within(reach, positions, marks); }

} // namespace lockstep::dust
