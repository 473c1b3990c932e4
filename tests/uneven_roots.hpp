#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "reference/model/profile.hpp"

namespace lockstep::test {

/// Tables as a driver may have them whose roots are off by up to two units in the last place, here more and there less,
/// so that they do not rise everywhere.
inline std::shared_ptr<const RootTables> uneven_roots() {
    auto tables = std::make_shared<RootTables>();
    tables->reciprocal.resize(std::size_t{1} << 23U);
    tables->inverse_sqrt.resize(std::size_t{1} << 24U);
    const auto off = [](float x, std::uint64_t key, int most) {
        key = (key + 1) * 0x9e3779b97f4a7c15U;
        const auto ulp = static_cast<int>((key >> 40U) % (2 * static_cast<unsigned>(most) + 1)) - most;
        return std::bit_cast<float>(std::bit_cast<std::int32_t>(x) + ulp);
    };
    const auto count = static_cast<std::ptrdiff_t>(tables->inverse_sqrt.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const float x = std::bit_cast<float>(0x3f800000U + static_cast<std::uint32_t>(i));
        if (i < tables->reciprocal.size())
            tables->reciprocal[i] = i == 0 ? 1.0F : off(1.0F / x, i, 1);
        tables->inverse_sqrt[i] = i == 0 ? 1.0F : off(static_cast<float>(1.0 / std::sqrt(double{x})), ~i, 2);
    }
    return tables;
}

/// NVIDIA's profile with such tables.
inline Profile profile_with_roots() {
    static const std::shared_ptr<const RootTables> tables = uneven_roots();
    Profile profile = named_profile("nvidia");
    profile.roots = tables;
    return profile;
}

} // namespace lockstep::test
