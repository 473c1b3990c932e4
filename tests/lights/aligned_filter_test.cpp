#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/aligned_filter.hpp"

namespace lockstep::test::aligned_filter_test {

/// Filtering in fixed point, held to what a texture unit was measured to give (data/results/h200/filter.txt: format,
/// places behind a cell's first texel on each axis, in texels, the cell's texels, the result).

namespace {

struct Measured {
    FilterBits bits{};
    std::array<double, 3> behind{};
    FilterCell cell{};
    float result = 0.0F;
};

std::vector<Measured> measured() {
    std::vector<Measured> all;
    std::ifstream file("data/results/h200/filter.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string format;
        words >> format >> std::hex;
        const auto next = [&] {
            std::uint32_t bits = 0;
            words >> bits;
            return std::bit_cast<float>(bits);
        };
        Measured one;
        one.bits = format == "rgba16f" ? half_filter_bits : float_filter_bits;
        for (double& behind : one.behind)
            behind = double{next()};
        for (float& texel : one.cell)
            texel = next();
        one.result = next();
        REQUIRE(words);
        all.push_back(one);
    }
    REQUIRE(all.size() == 376);
    return all;
}

std::array<int, 3> parts_of(const Measured& one, double parts = 256.0) {
    std::array<int, 3> made{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        made[axis] = static_cast<int>(std::floor(one.behind[axis] * parts + 0.5) * (256.0 / parts));
    return made;
}

/// How many results lie outside of what is known where a unit's bits, or how finely it divides a texel, are others.
template <class Change> std::size_t missed(const Change& change, double parts = 256.0) {
    std::size_t count = 0;
    for (Measured one : measured()) {
        change(one);
        const auto [low, high] = aligned_sum(one.cell, filter_weights(parts_of(one, parts)), one.bits);
        count += low <= one.result && one.result <= high ? 0 : 1;
    }
    return count;
}

} // namespace

TEST_CASE("aligned filter: what was measured of a texture unit is what is known of it, nearly always to the bit") {
    std::size_t open = 0;
    for (const Measured& one : measured()) {
        const auto [low, high] = aligned_sum(one.cell, filter_weights(parts_of(one)), one.bits);
        CHECK(low <= one.result);
        CHECK(one.result <= high);
        open += low < high ? 1 : 0;
    }
    CHECK(open <= 4);
}

TEST_CASE("aligned filter: a unit that is coarser or finer is told from it") {
    CHECK(missed([](Measured&) {}) == 0);
    CHECK(missed([](Measured&) {}, 128.0) > 100);
    CHECK(missed([](Measured&) {}, 512.0) > 100);
    CHECK(missed([](Measured& one) { one.bits.texel -= 4; }) > 20);
    CHECK(missed([](Measured& one) { one.bits.texel += 8; }) > 10);
    CHECK(missed([](Measured& one) { one.bits.result -= 1; }) > 100);
    CHECK(missed([](Measured& one) { one.bits.result += 1; }) > 100);
    // Weights that are products, not 256ths of a cell.
    std::size_t count = 0;
    for (const Measured& one : measured()) {
        double sum = 0.0;
        for (std::size_t k = 0; k < one.cell.size(); ++k) {
            double weight = one.cell[k];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double share = parts_of(one)[axis] / 256.0;
                weight *= (k >> axis & 1U) != 0 ? share : 1.0 - share;
            }
            sum += weight;
        }
        count += std::fabs(sum - double{one.result}) > std::ldexp(std::fabs(sum), -11) ? 1U : 0U;
    }
    CHECK(count > 100);
}

TEST_CASE("aligned filter: weights of a cell make up a whole, and a texel's middle has all of it") {
    std::size_t wrong = 0;
    for (int x = 0; x < 256; x += 5)
        for (int y = 0; y < 256; y += 3)
            for (int z = 0; z < 256; z += 7) {
                int sum = 0;
                for (const int weight : filter_weights({x, y, z}))
                    sum += weight < 0 ? 1000 : weight;
                wrong += sum == 256 ? 0U : 1U;
            }
    CHECK(wrong == 0);
    CHECK(filter_weights({0, 0, 0})[0] == 256);
    const FilterCell alike{0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F};
    CHECK(aligned_sum(alike, filter_weights({77, 130, 201}), float_filter_bits).first == 0.3F);
}

} // namespace lockstep::test::aligned_filter_test
