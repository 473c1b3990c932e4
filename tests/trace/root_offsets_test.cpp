#include <catch2/catch.hpp>

#include <bit>
#include <cmath>

#include "crosscheck/record/root_offsets.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::root_offsets_test {

namespace {

/// A driver that rounds some values down.
RootTables coarse_tables() {
    RootTables tables{std::vector<float>(reciprocal_count), std::vector<float>(inverse_sqrt_count)};
    for (std::size_t i = 0; i < inverse_sqrt_count; ++i) {
        const float x = std::bit_cast<float>(0x3f800000U + static_cast<std::uint32_t>(i));
        if (i < reciprocal_count)
            tables.reciprocal[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0F / x) & ~3U);
        tables.inverse_sqrt[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0F / std::sqrt(x)) & ~1U);
    }
    return tables;
}

} // namespace

TEST_CASE("root offsets: a driver's tables come back bit for bit") {
    const RootTables tables = coarse_tables();
    const RootTables back = root_tables(root_offsets(tables));
    CHECK(back.reciprocal == tables.reciprocal);
    CHECK(back.inverse_sqrt == tables.inverse_sqrt);
}

TEST_CASE("root offsets: a table too far off is refused") {
    RootTables tables = coarse_tables();
    tables.inverse_sqrt[77] = 0.9F;
    CHECK_THAT(test::error_of([&] { root_offsets(tables); }),
               Catch::Contains("the driver's inversesqrt is more than 127 units in the last place off"));
}

} // namespace lockstep::test::root_offsets_test
