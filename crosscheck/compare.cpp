#include "crosscheck/compare.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

bool worse(const Difference& a, const Difference& b) {
    return std::tuple(-a.ulp, a.field, a.index, a.component) < std::tuple(-b.ulp, b.field, b.index, b.component);
}

void keep_worst(std::vector<Difference>& worst, const Difference& difference) {
    const auto place = std::upper_bound(worst.begin(), worst.end(), difference, worse);
    if (place == worst.end() && worst.size() == Comparison::worst_kept)
        return;
    worst.insert(place, difference);
    if (worst.size() > Comparison::worst_kept)
        worst.pop_back();
}

/// One element's components, `count` floats each side.
bool compare_element(const float* reference, const float* gpu, int count, Field field, std::size_t index,
                     Comparison& into) {
    FieldCount& counts = into[field];
    bool differs = false;
    for (int c = 0; c < count; ++c) {
        if (gpu[c] != gpu[c])
            ++counts.nan;
        if (same_bits(reference[c], gpu[c]))
            continue;
        differs = true;
        ++counts.differing;
        keep_worst(into.worst, {field, index, c, reference[c], gpu[c], ulp_distance(reference[c], gpu[c])});
    }
    return differs;
}

/// Most blocks are equal to the last bit and hold no NaN: one pass over the words settles those.
bool block_is_clean(const float* reference, const float* gpu, std::size_t floats) {
    std::uint32_t unequal = 0;
    std::uint32_t nan = 0;
    for (std::size_t i = 0; i < floats; ++i) {
        const auto a = std::bit_cast<std::uint32_t>(reference[i]);
        const auto b = std::bit_cast<std::uint32_t>(gpu[i]);
        unequal |= a ^ b;
        nan |= static_cast<std::uint32_t>((b & 0x7fffffffU) > 0x7f800000U);
    }
    return unequal == 0 && nan == 0;
}

constexpr std::size_t block = 1024;

/// Calls `element(i, into)` for the elements of every block that is not clean in all of its arrays.
template <class Clean, class Element>
Comparison compare_blocks(std::size_t count, const Clean& clean, const Element& element) {
    const auto blocks = static_cast<std::ptrdiff_t>((count + block - 1) / block);
    Comparison total;
#pragma omp parallel
    {
        Comparison mine;
#pragma omp for schedule(static) nowait
        for (std::ptrdiff_t b = 0; b < blocks; ++b) {
            const std::size_t first = static_cast<std::size_t>(b) * block;
            const std::size_t last = std::min(first + block, count);
            if (clean(first, last - first))
                continue;
            for (std::size_t i = first; i < last; ++i)
                element(i, mine);
        }
#pragma omp critical
        total.add(mine);
    }
    return total;
}

} // namespace

std::uint64_t Comparison::compared() const {
    std::uint64_t sum = 0;
    for (const FieldCount& field : fields)
        sum += field.compared;
    return sum;
}

void Comparison::add(const Comparison& other) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
        fields[f].compared += other.fields[f].compared;
        fields[f].differing += other.fields[f].differing;
        fields[f].nan += other.fields[f].nan;
    }
    differing_particles += other.differing_particles;
    differing_texels += other.differing_texels;
    for (const Difference& difference : other.worst)
        keep_worst(worst, difference);
}

Comparison compare(const Particles& reference, const Particles& gpu) {
    assert(reference.size() == gpu.size());
    const std::size_t count = gpu.size();
    const auto clean = [&](std::size_t first, std::size_t n) {
        return block_is_clean(&reference.position[first].x, &gpu.position[first].x, 3 * n) &&
               block_is_clean(&reference.direction[first].x, &gpu.direction[first].x, 3 * n) &&
               block_is_clean(&reference.speed[first], &gpu.speed[first], n) &&
               block_is_clean(&reference.collide_time[first], &gpu.collide_time[first], n);
    };
    Comparison result = compare_blocks(count, clean, [&](std::size_t i, Comparison& into) {
        const bool position =
            compare_element(&reference.position[i].x, &gpu.position[i].x, 3, Field::position, i, into);
        const bool direction =
            compare_element(&reference.direction[i].x, &gpu.direction[i].x, 3, Field::direction, i, into);
        const bool speed = compare_element(&reference.speed[i], &gpu.speed[i], 1, Field::speed, i, into);
        const bool time =
            compare_element(&reference.collide_time[i], &gpu.collide_time[i], 1, Field::collide_time, i, into);
        into.differing_particles += position || direction || speed || time;
    });
    result[Field::position].compared = 3 * count;
    result[Field::direction].compared = 3 * count;
    result[Field::speed].compared = count;
    result[Field::collide_time].compared = count;
    return result;
}

Comparison compare(const CollisionImage& reference, const CollisionImage& gpu) {
    assert(reference.width == gpu.width && reference.height == gpu.height);
    const std::size_t count = gpu.texels.size();
    const auto clean = [&](std::size_t first, std::size_t n) {
        return block_is_clean(&reference.texels[first].x, &gpu.texels[first].x, 4 * n);
    };
    Comparison result = compare_blocks(count, clean, [&](std::size_t i, Comparison& into) {
        into.differing_texels += compare_element(&reference.texels[i].x, &gpu.texels[i].x, 4, Field::texel, i, into);
    });
    result[Field::texel].compared = 4 * count;
    return result;
}

std::vector<std::size_t> differing_particles(const Particles& reference, const Particles& gpu) {
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < gpu.size(); ++i)
        if (!same_bits(reference[i], gpu[i]))
            differing.push_back(i);
    return differing;
}

std::vector<std::size_t> differing_texels(const CollisionImage& reference, const CollisionImage& gpu) {
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < gpu.texels.size(); ++i)
        if (!same_bits(reference.texels[i], gpu.texels[i]))
            differing.push_back(i);
    return differing;
}

} // namespace lockstep
