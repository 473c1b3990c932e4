#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reference/packed_roots.hpp"
#include "reference/subnormals.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::packed_roots_test {

namespace {

bool same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

/// Around each power of two, zero and infinity; and everything in between, in steps.
std::vector<float> numbers() {
    std::vector<float> all;
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32U; bits += 0x800000U)
        for (std::int64_t near = -3; near <= 3; ++near)
            all.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits + static_cast<std::uint64_t>(near))));
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32U; bits += 7919)
        all.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    return all;
}

} // namespace

TEST_CASE(
    "packed roots: the bits of the tables for numbers of every exponent, whatever the thread does to subnormals") {
    const Profile profile = test::profile_with_roots();
    const RootTables& tables = *profile.roots;
    const auto packed = packed_roots(profile.roots);
    REQUIRE(packed);
    for (const bool flush : {false, true}) {
        std::size_t wrong = 0;
        for (const float x : numbers()) {
            const FlushSubnormals drivers(true);
            const float reciprocal = tables.reciprocal_of(x), inverse = tables.inverse_sqrt_of(x);
            const float root = tables.reciprocal_of(inverse);
            const FlushSubnormals guard(flush);
            float of_many[3];
            packed->reciprocals(&x, 1, &of_many[0]);
            packed->sqrts(&x, 1, &of_many[1], &of_many[2]);
            const bool right = same(packed->reciprocal(x), reciprocal) && same(packed->inverse_sqrt(x), inverse) &&
                               same(packed->sqrt(x), root) && same(of_many[0], reciprocal) && same(of_many[1], root) &&
                               same(of_many[2], inverse);
            wrong += right ? 0 : 1;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("packed roots: the error of a root is the largest that the tables make") {
    const Profile profile = test::profile_with_roots();
    const auto packed = packed_roots(profile.roots);
    double largest = 0.0;
    for (std::uint32_t bits = 0x3f800000U; bits < 0x40800000U; bits += 5) {
        const float x = std::bit_cast<float>(bits);
        const float root = profile.roots->reciprocal_of(profile.roots->inverse_sqrt_of(x));
        largest = std::max(largest, std::abs(static_cast<double>(root) / std::sqrt(static_cast<double>(x)) - 1.0));
    }
    CHECK(packed->sqrt_error() >= largest);
    CHECK(packed->sqrt_error() < 1.2 * largest);
}

TEST_CASE("packed roots: made once for tables, and anew for others") {
    const Profile profile = test::profile_with_roots();
    CHECK(packed_roots(profile.roots) == packed_roots(profile.roots));
    CHECK(packed_roots(std::make_shared<const RootTables>(*profile.roots)) != packed_roots(profile.roots));
    CHECK(packed_roots(nullptr) == nullptr);
}

TEST_CASE("packed roots: no number, one that is too far off, half a table and a listener are not packed") {
    const RootTables right = *test::profile_with_roots().roots;
    const auto packs = [&](const auto& change) {
        RootTables tables = right;
        change(tables);
        return PackedRoots::pack(tables) != nullptr;
    };
    CHECK(packs([](RootTables&) {}));
    CHECK_FALSE(packs([](RootTables& t) { t.reciprocal[77] = std::nanf(""); }));
    CHECK_FALSE(packs([](RootTables& t) { t.inverse_sqrt[78] *= 1.00001F; }));
    CHECK_FALSE(packs([](RootTables& t) { t.inverse_sqrt.pop_back(); }));
    CHECK_FALSE(packs([](RootTables& t) { t.on_lookup = [](const std::vector<float>&, std::size_t) {}; }));
}

} // namespace lockstep::test::packed_roots_test
