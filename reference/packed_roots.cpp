#include "reference/packed_roots.hpp"

#include <algorithm>
#include <mutex>

namespace lockstep {
namespace {

constexpr std::uint32_t reciprocal_count = 1U << 23U, root_count = 1U << 24U;

/// Four bits of how far a value is from a plain one; `too_far` gets a bit where they do not hold it.
std::uint32_t packed_off(float value, std::int32_t plain, std::uint32_t& too_far) {
    const std::int64_t off = std::int64_t{std::bit_cast<std::int32_t>(value)} - plain + 8;
    too_far |= off < 0 || off > 15 ? 1U : 0U;
    return static_cast<std::uint32_t>(off) & 15U;
}

} // namespace

std::shared_ptr<const PackedRoots> PackedRoots::pack(const RootTables& tables) {
    if (tables.on_lookup || tables.reciprocal.size() != reciprocal_count || tables.inverse_sqrt.size() != root_count)
        return nullptr;
    auto packed = std::make_shared<PackedRoots>();
    packed->reciprocal_.resize(reciprocal_count / 2);
    packed->roots_.resize(root_count);
    const auto number = [](std::uint32_t i) { return std::bit_cast<float>(one + i); };
    std::uint32_t too_far = 0;
#pragma omp parallel for schedule(static) reduction(| : too_far)
    for (std::uint32_t i = 0; i < reciprocal_count; i += 2) {
        const auto off = [&](std::uint32_t k) {
            return packed_off(tables.reciprocal[k], plain_reciprocal(number(k)), too_far);
        };
        packed->reciprocal_[i / 2] = static_cast<std::uint8_t>(off(i) | off(i + 1) << 4U);
    }
    // Roots of other numbers are these times a power of two: an inverse root is far from all that is flushed.
    double error = 0.0;
#pragma omp parallel for schedule(static) reduction(| : too_far) reduction(max : error)
    for (std::uint32_t i = 0; i < root_count; ++i) {
        const float x = number(i), inverse = tables.inverse_sqrt[i], root = packed->reciprocal(inverse);
        packed->roots_[i] = static_cast<std::uint8_t>(packed_off(inverse, plain_inverse_sqrt(x), too_far) |
                                                      packed_off(root, plain_sqrt(x), too_far) << 4U);
        error = std::max(error, std::abs(static_cast<double>(root) / std::sqrt(static_cast<double>(x)) - 1.0));
    }
    packed->sqrt_error_ = error;
    return too_far == 0 ? packed : nullptr;
}

std::shared_ptr<const PackedRoots> packed_roots(const std::shared_ptr<const RootTables>& tables) {
    struct Packed {
        std::weak_ptr<const RootTables> of;
        std::shared_ptr<const PackedRoots> roots;
    };
    static std::mutex mutex;
    static std::vector<Packed> known;
    if (tables == nullptr)
        return nullptr;
    const std::lock_guard lock(mutex);
    std::erase_if(known, [](const Packed& packed) { return packed.of.expired(); });
    for (const Packed& packed : known)
        if (!packed.of.owner_before(tables) && !tables.owner_before(packed.of))
            return packed.roots;
    return known.emplace_back(tables, PackedRoots::pack(*tables)).roots;
}

} // namespace lockstep
