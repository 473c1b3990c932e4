#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

#include "reference/model/error.hpp"
#include "reference/text/outcomes.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::group_outcomes_test {

using Catch::Contains;

namespace {

constexpr std::uint32_t size = 8;

/// A group of eight that computes on `float x[]`, from words of which it has a copy.
struct Group {
    explicit Group(const std::string& text, const std::vector<float>& given)
        : kernel("layout(local_size_x = 8) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n" + text),
          of(kernel.program) {
        kernel.blocks["Out"] = words_of(given);
    }
    [[nodiscard]] std::vector<std::vector<text::InvocationOutcome>> outcomes(const KnownOperations& known = {}) {
        const std::vector<std::uint32_t> before = kernel.blocks["Out"];
        auto found = of.of_group(0, {1, 1, 1}, kernel.bindings(), named_profile("strict"), known);
        CHECK(kernel.blocks["Out"] == before);
        REQUIRE(found.size() == size);
        return found;
    }
    /// The only word that the invocation may write.
    [[nodiscard]] text::WrittenWord word(std::uint32_t invocation, const KnownOperations& known = {}) {
        const auto found = outcomes(known)[invocation];
        REQUIRE(found.size() == 1);
        REQUIRE(found[0].undefined == Undefined::none);
        REQUIRE(found[0].written.size() == 1);
        return found[0].written[0];
    }
    TextKernel kernel;
    text::Outcomes of;
};

std::vector<float> some_numbers() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-1.0F, 1.0F);
    std::vector<float> made(size);
    for (float& x : made)
        x = number(random);
    return made;
}

const std::string reduction = R"(
shared float s[8];
void main() {
    uint l = gl_LocalInvocationID.x;
    s[l] = x[l] * 1.1;
    for (uint step = 4u; step > 0u; step >>= 1u) {
        barrier();
        if (l < step)
            s[l] += s[l + step];
    }
    barrier();
    if (l == 0u)
        x[0] = s[0];
}
)";

} // namespace

TEST_CASE("group outcomes: what others leave behind barriers is a set, round by round") {
    const std::vector<float> given = some_numbers();
    const text::WrittenWord sum = Group(reduction, given).word(0);
    CHECK(sum.set.low < sum.set.high);
    std::vector<float> fused = given, rounded = given;
    for (float& x : rounded)
        x *= 1.1F;
    for (std::uint32_t step = 4; step > 0; step /= 2)
        for (std::uint32_t l = 0; l < step; ++l)
            rounded[l] += rounded[l + step];
    CHECK(sum.may_be(std::bit_cast<std::uint32_t>(rounded[0])));
    double exact = 0.0;
    for (const float x : given)
        exact += double{x} * 1.1;
    CHECK(sum.set.low <= exact + 1e-7);
    CHECK(sum.set.high >= exact - 1e-7);
    CHECK(sum.set.high - sum.set.low < 1e-5); // a term that is missing is far outside
    CHECK_FALSE(sum.may_be(std::bit_cast<std::uint32_t>(rounded[0] - 1.1F * given[3])));
}

TEST_CASE("group outcomes: with precise and known operations each word is one float") {
    std::string text = reduction;
    const std::string product = "s[l] = x[l] * 1.1;", sum = "s[l] += s[l + step];";
    text.replace(text.find(product), product.size(), "precise float p = x[l] * 1.1; s[l] = p;");
    text.replace(text.find(sum), sum.size(), "{ precise float p = s[l] + s[l + step]; s[l] = p; }");
    CHECK(Group(text, some_numbers()).word(0, KnownOperations::all()).set.is_point());
}

TEST_CASE("group outcomes: a tile of loaded words is exact, and integers and histograms of a group are") {
    Group tile("shared float s[8];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\ns[l] = x[l];\nbarrier();\n"
               "x[l] = s[7u - l];\n}\n",
               some_numbers());
    for (std::uint32_t i = 0; i < size; ++i)
        CHECK(tile.word(i).set.as_float() == some_numbers()[7 - i]);
    Group histogram("shared uint bins[2];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\nif (l < 2u) bins[l] = 0u;\n"
                    "barrier();\natomicAdd(bins[l < 3u ? 0 : 1], l + 1u);\nbarrier();\nif (l < 2u) x[l] = "
                    "float(bins[l]);\n}\n",
                    some_numbers());
    CHECK(histogram.word(0).set.as_float() == 6.0F);
    CHECK(histogram.word(1).set.as_float() == 30.0F);
}

TEST_CASE("group outcomes: blocks and images that the group writes are read back as sets") {
    Group block(
        "void main() {\nuint l = gl_LocalInvocationID.x;\nx[l] = x[l] * 1.1;\nmemoryBarrierBuffer();\nbarrier();\n"
        "float y = x[(l + 1u) & 7u];\nbarrier();\nx[l] = y;\n}\n",
        some_numbers());
    const text::WrittenWord moved = block.word(2);
    CHECK(moved.set.low < moved.set.high);
    CHECK(moved.set.contains(some_numbers()[3] * 1.1F));
}

TEST_CASE("group outcomes: a branch that rounding leaves open leaves what others find there either way") {
    // 0.1 * 3 and 0.3 are one float or neighbours, by how the product is rounded.
    Group open("shared uint s[8];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\ns[l] = 7u;\nbarrier();\n"
               "if (x[l] * 3.0 > 0.3) s[l] = 9u;\nbarrier();\nx[l] = float(s[(l + 1u) & 7u]);\n}\n",
               std::vector<float>(size, 0.1F));
    const auto found = open.outcomes()[0];
    const auto may_be = [&](float value) {
        return std::any_of(found.begin(), found.end(),
                           [&](const text::InvocationOutcome& one) { return one.written.at(0).set.contains(value); });
    };
    CHECK(may_be(7.0F));
    CHECK(may_be(9.0F));
    CHECK_FALSE(may_be(6.0F));
    CHECK_FALSE(may_be(10.0F));
}

TEST_CASE("group outcomes: what others make of operands without a result is open with its reason") {
    Group undefined(
        "shared float s[8];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\ns[l] = sqrt(x[l] - 0.5);\nbarrier();\n"
        "x[l] = s[(l + 1u) & 7u];\n}\n",
        {1, 1, 1, 0, 1, 1, 1, 1});
    const auto found = undefined.outcomes();
    REQUIRE(found[2].size() == 1);
    CHECK(found[2][0].undefined == Undefined::not_a_number);
    CHECK(found[3][0].undefined == Undefined::none);
    // It ends in the middle of a stretch: nothing is known of what it would have left.
    Group ends("shared float s[8];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\ns[l] = 2.0;\nbarrier();\n"
               "if (sqrt(x[l] - 0.5) > 0.2) s[l] = 3.0;\nbarrier();\nx[l] = s[(l + 1u) & 7u];\n}\n",
               {1, 1, 1, 0, 1, 1, 1, 1});
    CHECK(ends.outcomes()[2][0].undefined != Undefined::none);
    CHECK(ends.outcomes()[1][0].undefined == Undefined::none);
}

TEST_CASE("group outcomes: a sum, minimum or maximum of open words by atomic operations is a range") {
    Group most("shared uint top;\nvoid main() {\nuint l = gl_LocalInvocationID.x;\nif (l == 0u) top = 0u;\nbarrier();\n"
               "atomicMax(top, floatBitsToUint(exp(x[l])));\nbarrier();\nx[l] = x[l] / uintBitsToFloat(top);\n}\n",
               some_numbers());
    const std::vector<float> given = some_numbers();
    const float largest = *std::max_element(given.begin(), given.end());
    const text::WrittenWord share = most.word(3);
    CHECK(share.set.contains(static_cast<float>(given[3] / std::exp(double{largest}))));
    CHECK(share.set.high - share.set.low < 1e-4);
    CHECK_FALSE(share.set.contains(given[3] / (std::exp(largest) + 0.01F)));
    Group sum(
        "shared int total;\nvoid main() {\nuint l = gl_LocalInvocationID.x;\nif (l == 0u) total = 5;\nbarrier();\n"
        "atomicAdd(total, int(round(x[l] * 3.0 + 0.2)));\nbarrier();\nx[l] = float(total);\n}\n",
        std::vector<float>(size, 0.1F)); // 0.5 and a little, or a little less
    const auto found = sum.outcomes()[2];
    const auto may_be = [&](float value) {
        return std::any_of(found.begin(), found.end(),
                           [&](const text::InvocationOutcome& one) { return one.written.at(0).set.contains(value); });
    };
    CHECK(may_be(5.0F));
    CHECK(may_be(13.0F));
    CHECK_FALSE(may_be(14.0F));
    CHECK_FALSE(may_be(4.0F));
}

TEST_CASE("group outcomes: more ways than are followed end soon, and what they leave is open") {
    // A sort of numbers that rounding leaves open, all of them near to each other.
    Group sort(
        "shared float t[8];\nvoid main() {\nuint l = gl_LocalInvocationID.x;\nt[l] = pow(x[l], 0.1);\nbarrier();\n"
        "float v[8];\nfor (int k = 0; k < 8; ++k) v[k] = t[k];\nfor (int n = 0; n < 8; ++n)\n"
        "for (int k = 0; k < 7; ++k)\nif (v[k] > v[k + 1]) {\nfloat kept = v[k];\nv[k] = v[k + 1];\n"
        "v[k + 1] = kept;\n}\nbarrier();\nt[l] = v[l];\nbarrier();\nx[l] = t[7u - l];\n}\n",
        {1.0F, 1.0000001F, 1.0000002F, 1.0000003F, 1.0000004F, 1.0000005F, 1.0000006F, 1.0000007F});
    const auto found = sort.outcomes();
    CHECK(std::any_of(found[0].begin(), found[0].end(),
                      [](const text::InvocationOutcome& one) { return one.undefined == Undefined::undecided; }));
    const text::Bindings bindings = sort.kernel.bindings();
    const text::DispatchOutcomes all(sort.of, bindings, {.profile = named_profile("strict")});
    CHECK_FALSE(all.of({.number = 3}).empty());
}

TEST_CASE("group outcomes: what the order of atomic operations decides is refused by its line") {
    Group order("shared uint n;\nvoid main() {\nif (gl_LocalInvocationID.x == 0u) n = 0u;\nbarrier();\n"
                "uint mine = atomicAdd(n, 1u);\nx[mine] = 1.0;\n}\n",
                some_numbers());
    CHECK_THROWS_WITH(order.outcomes(), Contains("kernel.comp:7"));
}

TEST_CASE("group outcomes: of random kernels the plain run is inside, and a changed word is not everywhere") {
    std::mt19937 random(11);
    for (int k = 0; k < 40; ++k) {
        std::string body = "uint l = gl_LocalInvocationID.x;\ns[l] = x[l];\nbarrier();\nfloat a = s[(l + 1u) & 7u];\n";
        for (int step = 0; step < 4; ++step) {
            switch (random() % 4) {
            case 0:
                body += "a = a * 1.3 + s[(l + 3u) & 7u];\n";
                break;
            case 1:
                body += "a = sqrt(abs(a) + 0.1) - x[l];\n";
                break;
            case 2:
                body += "if (a > 0.2) a -= 0.4 * s[l];\n";
                break;
            default:
                body += "barrier();\ns[l] = a;\nbarrier();\na += s[(l + 5u) & 7u] / 3.0;\n";
            }
        }
        const std::vector<float> given = some_numbers();
        Group group("shared float s[8];\nvoid main() {\n" + body + "x[l] = a;\n}\n", given);
        const auto found = group.outcomes();
        group.kernel.run({1, 1, 1}, named_profile("strict"));
        for (std::uint32_t i = 0; i < size; ++i) {
            INFO(body << " invocation " << i);
            const std::uint32_t plain = group.kernel.blocks["Out"][i];
            const auto allows = [&](std::uint32_t word) {
                return std::any_of(found[i].begin(), found[i].end(), [&](const text::InvocationOutcome& one) {
                    return one.undefined != Undefined::none || one.written.at(0).may_be(word);
                });
            };
            CHECK(allows(plain));
            CHECK_FALSE(allows(std::bit_cast<std::uint32_t>(std::bit_cast<float>(plain) + 0.05F)));
        }
    }
}

} // namespace lockstep::test::group_outcomes_test
