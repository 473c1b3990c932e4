#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <spirv.hpp>

#include "reference/text/word_range.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::word_range_test {

using text::WordRange;

namespace {

struct Operation {
    std::uint32_t op;
    const char* expression; ///< of the words x[1] and x[2]
};

/// Every operation that ranges know, as GLSL has it.
const std::vector<Operation>& operations() {
    static const std::vector<Operation> all{
        {spv::OpSNegate, "uint(-int(x[1]))"},
        {spv::OpNot, "~x[1]"},
        {spv::OpIAdd, "x[1] + x[2]"},
        {spv::OpISub, "x[1] - x[2]"},
        {spv::OpIMul, "x[1] * x[2]"},
        {spv::OpUDiv, "x[1] / x[2]"},
        {spv::OpSDiv, "uint(int(x[1]) / int(x[2]))"},
        {spv::OpIEqual, "uint(x[1] == x[2])"},
        {spv::OpINotEqual, "uint(x[1] != x[2])"},
        {spv::OpUGreaterThan, "uint(x[1] > x[2])"},
        {spv::OpSGreaterThan, "uint(int(x[1]) > int(x[2]))"},
        {spv::OpUGreaterThanEqual, "uint(x[1] >= x[2])"},
        {spv::OpSGreaterThanEqual, "uint(int(x[1]) >= int(x[2]))"},
        {spv::OpULessThan, "uint(x[1] < x[2])"},
        {spv::OpSLessThan, "uint(int(x[1]) < int(x[2]))"},
        {spv::OpULessThanEqual, "uint(x[1] <= x[2])"},
        {spv::OpSLessThanEqual, "uint(int(x[1]) <= int(x[2]))"},
        {spv::OpShiftRightLogical, "x[1] >> (x[2] & 31u)"},
        {spv::OpShiftRightArithmetic, "uint(int(x[1]) >> (x[2] & 31u))"},
        {spv::OpShiftLeftLogical, "x[1] << (x[2] & 31u)"},
        {spv::OpBitwiseOr, "x[1] | x[2]"},
        {spv::OpBitwiseXor, "x[1] ^ x[2]"},
        {spv::OpBitwiseAnd, "x[1] & x[2]"},
    };
    return all;
}

std::uint32_t computed(const TextKernel& kernel, std::uint32_t a, std::uint32_t b) {
    std::vector<std::uint32_t> words{0, a, b};
    text::Bindings bindings;
    bindings.blocks.emplace_back(words);
    text::Findings findings;
    text::run_dispatch(kernel.program, {1, 1, 1}, bindings, named_profile("strict"), findings);
    return words[0];
}

} // namespace

TEST_CASE("text word range: holds what the operation makes of each word, and of single words that alone") {
    std::mt19937 random(11);
    const auto pick = [&]() -> std::uint32_t {
        constexpr std::uint32_t edges[] = {0U, 1U, 0x7fffffffU, 0x80000000U, 0xffffffffU, 0x3f800000U, 0xbf7fffffU};
        switch (random() % 4) {
        case 0:
            return edges[random() % std::size(edges)] + static_cast<std::uint32_t>(random() % 5) - 2;
        case 1:
            return static_cast<std::uint32_t>(random() % 40);
        default:
            return static_cast<std::uint32_t>(random());
        }
    };
    for (const Operation& operation : operations()) {
        CAPTURE(operation.expression);
        const TextKernel kernel("layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer B { uint x[]; };\n"
                                "void main() { x[0] = " +
                                std::string(operation.expression) + "; }\n");
        REQUIRE(text::word_range::is_known(operation.op));
        int followed = 0;
        for (int round = 0; round < 300; ++round) {
            const WordRange a{pick(), random() % 3 == 0 ? 0U : static_cast<std::uint32_t>(random() % 6)},
                b{pick(), random() % 4 != 0 ? 0U : static_cast<std::uint32_t>(random() % 4)};
            const std::optional<WordRange> made = text::word_range::of(operation.op, a, b);
            const bool are_single = a.more == 0 && b.more == 0;
            REQUIRE((made || !are_single));
            if (!made)
                continue;
            ++followed;
            CAPTURE(a.first, a.more, b.first, b.more, made->first, made->more);
            for (std::uint32_t i = 0; i <= a.more; ++i)
                for (std::uint32_t k = 0; k <= b.more; ++k) {
                    const std::uint32_t exact = computed(kernel, a.first + i, b.first + k);
                    REQUIRE(made->contains(exact));
                    if (are_single)
                        REQUIRE(*made == WordRange{exact, 0});
                }
        }
        CHECK(followed > 100);
    }
}

TEST_CASE("text word range: wide ranges keep what is known of their words") {
    const auto of = [](std::uint32_t op, WordRange a, std::uint32_t b) {
        return text::word_range::of(op, a, {b, 0}).value();
    };
    const WordRange near_one{0x3f7ffff0U, 0x20U}; // bits of floats on both sides of 1
    CHECK(of(spv::OpIAdd, near_one, 3U << 23U) == WordRange{0x40fffff0U, 0x20U});
    CHECK(of(spv::OpShiftRightLogical, near_one, 23U) == WordRange{126, 1});
    CHECK(of(spv::OpBitwiseAnd, near_one, 0x80000000U) == WordRange{0, 0});
    CHECK(of(spv::OpBitwiseXor, near_one, 0x80000000U) == WordRange{0xbf7ffff0U, 0x20U});
    CHECK(of(spv::OpULessThan, near_one, 0x3f800011U) == WordRange{1, 0});
    CHECK(of(spv::OpULessThan, near_one, 0x3f800010U) == WordRange{0, 1});
    CHECK(of(spv::OpIEqual, near_one, 5U) == WordRange{0, 0});
    CHECK_FALSE(text::word_range::of(spv::OpIMul, near_one, {1103515245U, 0}));
    CHECK_FALSE(text::word_range::of(spv::OpIMul, near_one, near_one));
}

TEST_CASE("text word range: floats and their bits, of either sign") {
    using text::word_range::bits, text::word_range::floats;
    const auto word = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const Interval above(1.5, 2.5), below(-2.5, -1.5), wide(-1.0, 1.0);
    CHECK(bits(above)->first == word(1.5F));
    CHECK(bits(above)->last() == word(2.5F));
    CHECK(bits(below)->first == word(-1.5F));
    CHECK(bits(below)->last() == word(-2.5F));
    CHECK_FALSE(bits(wide));
    CHECK_FALSE(bits(Interval::anything()));
    for (const Interval& set : {above, below, Interval(0.0, 0.25), Interval(-0.25, -0.0)}) {
        const Interval back = floats(bits(set).value()).value();
        CHECK(back.low == set.low);
        CHECK(back.high == set.high);
    }
    CHECK_FALSE(floats({word(1.0F), 0x80000000U - word(1.0F)})); // up to -0
    CHECK_FALSE(floats({word(std::numeric_limits<float>::infinity()), 1}));
}

} // namespace lockstep::test::word_range_test
