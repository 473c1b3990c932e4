#include "crosscheck/judge/compare.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <tuple>

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

/// One item's components in one field.
bool compare_item(const View& reference, const View& gpu, std::uint8_t field, std::size_t item, Comparison& into) {
    FieldCount& counts = into.resources[reference.resource].fields[field];
    bool differs = false;
    for (int c = 0; c < reference.fields()[field].components; ++c) {
        const Value expected = reference.value(field, item, c);
        const Value got = gpu.value(field, item, c);
        if (got.is_nan())
            ++counts.nan;
        if (same_bits(expected, got))
            continue;
        differs = true;
        ++counts.differing;
        keep_worst(into.worst, {{reference.resource, field}, item, c, expected, got, distance(expected, got)});
    }
    return differs;
}

/// Whether words are equal to the last bit and none is NaN, were they floats.
bool clean(const std::byte* reference, const std::byte* gpu, std::size_t words) {
    std::uint32_t unequal = 0;
    std::uint32_t nan = 0;
    for (std::size_t i = 0; i < words; ++i) {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::memcpy(&a, reference + i * sizeof a, sizeof a);
        std::memcpy(&b, gpu + i * sizeof b, sizeof b);
        unequal |= a ^ b;
        nan |= static_cast<std::uint32_t>((b & 0x7fffffffU) > 0x7f800000U);
    }
    return unequal == 0 && nan == 0;
}

bool clean(const View& reference, const View& gpu, std::size_t field, std::size_t first, std::size_t items) {
    const auto words = static_cast<std::size_t>(gpu.fields()[field].components);
    const std::size_t from = first * words * sizeof(std::uint32_t);
    return clean(reference.columns[field] + from, gpu.columns[field] + from, items * words);
}

/// Most blocks are equal to the last bit and hold no NaN: one pass over the words settles those.
bool clean(const View& reference, const View& gpu, std::size_t first, std::size_t items) {
    for (std::size_t f = 0; f < gpu.columns.size(); ++f)
        if (!clean(reference, gpu, f, first, items))
            return false;
    return true;
}

bool has_same_values(const View& reference, const View& gpu, std::size_t item) {
    for (std::size_t f = 0; f < reference.fields().size(); ++f)
        for (int c = 0; c < reference.fields()[f].components; ++c)
            if (!same_bits(reference.value(f, item, c), gpu.value(f, item, c)))
                return false;
    return true;
}

constexpr std::size_t block = 1024;

Comparison nothing_of(const View& state) {
    Comparison none;
    none.resources.resize(state.resource + std::size_t{1});
    none.resources.back().fields.resize(state.fields().size());
    return none;
}

/// Notes that the first `items` were compared.
void count_compared(const View& reference, std::size_t items, ResourceCount& counts) {
    counts.extent = reference.extent;
    for (std::size_t f = 0; f < reference.fields().size(); ++f)
        counts.fields[f].compared =
            static_cast<std::uint64_t>(items) * static_cast<std::uint64_t>(reference.fields()[f].components);
}

/// Calls `item(i, into)` for the first `count` items, block by block, but for blocks that are clean.
template <class Item>
Comparison compare_blocks(const View& reference, const View& gpu, std::size_t count, const Item& item) {
    const Comparison none = nothing_of(reference);
    const auto blocks = static_cast<std::ptrdiff_t>((count + block - 1) / block);
    Comparison total = none;
#pragma omp parallel
    {
        Comparison mine = none;
#pragma omp for schedule(static) nowait
        for (std::ptrdiff_t b = 0; b < blocks; ++b) {
            const std::size_t first = static_cast<std::size_t>(b) * block;
            const std::size_t last = std::min(first + block, count);
            if (clean(reference, gpu, first, last - first))
                continue;
            for (std::size_t i = first; i < last; ++i)
                item(i, mine);
        }
#pragma omp critical
        total.add(mine);
    }
    return total;
}

} // namespace

bool Comparison::agree() const {
    return std::all_of(resources.begin(), resources.end(), [](const ResourceCount& r) { return r.differing == 0; });
}

std::uint64_t Comparison::compared() const {
    std::uint64_t sum = 0;
    for (std::size_t r = 0; r < resources.size(); ++r)
        sum += compared(static_cast<std::uint8_t>(r));
    return sum;
}

std::uint64_t Comparison::compared(std::uint8_t resource) const {
    std::uint64_t sum = 0;
    if (resource < resources.size())
        for (const FieldCount& field : resources[resource].fields)
            sum += field.compared;
    return sum;
}

std::uint64_t Comparison::differing(std::uint8_t resource) const {
    return resource < resources.size() ? resources[resource].differing : 0;
}

FieldCount Comparison::operator[](FieldId field) const {
    const bool compared = field.resource < resources.size() && field.field < resources[field.resource].fields.size();
    return compared ? resources[field.resource].fields[field.field] : FieldCount{};
}

void Comparison::add(const Comparison& other) {
    resources.resize(std::max(resources.size(), other.resources.size()));
    for (std::size_t r = 0; r < other.resources.size(); ++r) {
        ResourceCount& sum = resources[r];
        const ResourceCount& more = other.resources[r];
        sum.differing += more.differing;
        if (more.extent.count() > 0)
            sum.extent = more.extent;
        sum.fields.resize(std::max(sum.fields.size(), more.fields.size()));
        for (std::size_t f = 0; f < more.fields.size(); ++f) {
            sum.fields[f].compared += more.fields[f].compared;
            sum.fields[f].differing += more.fields[f].differing;
            sum.fields[f].nan += more.fields[f].nan;
        }
    }
    for (const Difference& difference : other.worst)
        keep_worst(worst, difference);
}

Comparison compare(const View& reference, const View& gpu) {
    assert(reference.schema == gpu.schema && reference.resource == gpu.resource);
    assert(reference.about().dimensions == 1 || reference.extent == gpu.extent);
    const std::size_t both = std::min(reference.count(), gpu.count());
    const auto fields = static_cast<std::uint8_t>(reference.fields().size());
    Comparison result = compare_blocks(reference, gpu, both, [&](std::size_t i, Comparison& into) {
        bool differs = false;
        for (std::uint8_t f = 0; f < fields; ++f)
            if (!clean(reference, gpu, f, i, 1))
                differs = compare_item(reference, gpu, f, i, into) || differs;
        into.resources.back().differing += differs ? 1U : 0U;
    });
    result.resources.back().differing += std::max(reference.count(), gpu.count()) - both;
    count_compared(reference, both, result.resources.back());
    return result;
}

Comparison agreement(const View& state) {
    Comparison result = nothing_of(state);
    count_compared(state, state.count(), result.resources.back());
    return result;
}

std::vector<std::size_t> differing_items(const View& reference, const View& gpu) {
    const std::size_t both = std::min(reference.count(), gpu.count());
    std::vector<std::vector<std::size_t>> parts((both + block - 1) / block);
    const auto blocks = static_cast<std::ptrdiff_t>(parts.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t b = 0; b < blocks; ++b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        const std::size_t last = std::min(first + block, both);
        if (clean(reference, gpu, first, last - first))
            continue;
        for (std::size_t i = first; i < last; ++i)
            if (!clean(reference, gpu, i, 1) && !has_same_values(reference, gpu, i))
                parts[static_cast<std::size_t>(b)].push_back(i);
    }
    std::vector<std::size_t> differing;
    for (const std::vector<std::size_t>& part : parts)
        differing.insert(differing.end(), part.begin(), part.end());
    return differing;
}

} // namespace lockstep
