#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "reference/model/error.hpp"
#include "reference/text/outcomes.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::outcomes_test {

using Catch::Contains;

namespace {

/// A text that computes on `float x[]`.
struct Statements {
    explicit Statements(const std::string& statements, const std::string& declarations = "")
        : kernel("layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n" +
                 declarations + "\nvoid main() {\n" + statements + "\n}\n"),
          of(kernel.program) {}

    /// What invocation 0 may legally leave in x[], where its words are those given.
    [[nodiscard]] std::vector<text::InvocationOutcome> outcomes(const std::vector<float>& given,
                                                                const KnownOperations& known = {}) const {
        std::vector<std::uint32_t> words = words_of(given);
        words.resize(16);
        const std::vector<std::uint32_t> before = words;
        std::vector<std::uint32_t> others(16);
        text::Bindings bindings;
        for (const text::Block& block : kernel.program.blocks)
            bindings.blocks.emplace_back(block.name == "Out" ? words : others);
        auto found = of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), known);
        CHECK(words == before);
        return found;
    }
    /// The set of x[0] of the one outcome.
    [[nodiscard]] Interval set(const std::vector<float>& given, const KnownOperations& known = {}) const {
        const auto found = outcomes(given, known);
        REQUIRE(found.size() == 1);
        REQUIRE(found[0].written.size() == 1);
        return found[0].written[0].set;
    }
    TextKernel kernel;
    text::Outcomes of;
};

std::vector<text::InvocationOutcome> outcomes(const std::string& statements, const std::vector<float>& given,
                                              const KnownOperations& known = KnownOperations(),
                                              const std::string& declarations = "") {
    return Statements(statements, declarations).outcomes(given, known);
}

Interval set_of(const std::string& expression, const std::vector<float>& given,
                const KnownOperations& known = KnownOperations()) {
    return Statements("x[0] = " + expression + ";").set(given, known);
}

double ulps(const Interval& set) {
    return (set.high - set.low) / interval::ulp(std::max(std::abs(set.low), std::abs(set.high)));
}

struct Function {
    std::string name;
    double (*exact)(double, double);
    float lowest, highest;
    double most_ulps; ///< of the set, beside an absolute width
    double most_absolute;
};

} // namespace

TEST_CASE("text outcomes: a product and sum without precise may be fused or not, with precise it is one float") {
    const float a = 1.1F, b = 0.9F, c = -0.99F;
    const Interval free = set_of("x[1] * x[2] + x[3]", {0, a, b, c});
    CHECK(free.contains(std::fma(a, b, c)));
    CHECK(free.contains(a * b + c));
    CHECK(free.low < free.high);
    const auto precise =
        outcomes("precise float y = x[1] * x[2] + x[3];\nx[0] = y;", {0, a, b, c}, KnownOperations::all());
    REQUIRE(precise.size() == 1);
    CHECK(precise[0].written[0].set.is_point());
    CHECK(precise[0].written[0].set.as_float() == a * b + c);
    const Interval fused = set_of("fma(x[1], x[2], x[3])", {0, a, b, c});
    CHECK(fused.contains(std::fma(a, b, c)));
    CHECK(fused.contains(a * b + c));
    CHECK_FALSE(fused.contains(std::nextafter(std::max(std::fma(a, b, c), a * b + c), 2.0F)));
}

TEST_CASE("text outcomes: what no order and no fusing changes is one float") {
    CHECK(set_of("x[1] - x[2]", {0, 1.0F, 0.25F}).is_point());
    CHECK(set_of("x[1] * x[2]", {0, 3.0F, 0.25F}).is_point());
    CHECK(set_of("x[1] + x[2]", {0, 3.0F, 0.25F}).is_point());
    CHECK_FALSE(set_of("x[1] * x[2]", {0, 1.1F, 1.3F}).is_point());
    CHECK_FALSE(set_of("x[1] + x[2]", {0, 1.0F, 0x1p-30F}).is_point());
}

TEST_CASE("text outcomes: a sum without precise is what some order of its terms gives") {
    const Interval cancels = set_of("(x[1] + 1e10) - 1e10", {0, 0.5F});
    CHECK(cancels.contains(0.0F));
    CHECK(cancels.contains(0.5F));
    CHECK(cancels.low > -1e-3);
    CHECK(cancels.high < 0.501);
    const Interval upwards = set_of("(x[1] + 1e10) - 1e10", {0, 700.0F}); // 1,024 is between floats there
    CHECK(upwards.contains(1024.0F));
    CHECK(upwards.contains(700.0F));
    CHECK_FALSE(upwards.contains(1100.0F));
    CHECK_FALSE(upwards.contains(600.0F));
    const float a = 1.1F, b = 2.3F, c = -3.4F;
    const Interval sum = set_of("x[1] + x[2] + x[3]", {0, a, b, c});
    for (const float order : {(a + b) + c, (a + c) + b, (b + c) + a})
        CHECK(sum.contains(order));
    CHECK(sum.high - sum.low < 1e-6);
}

TEST_CASE("text outcomes: built-in functions have GLSL's precision around the exact result") {
    const std::vector<Function> functions{
        {"exp(x[1])", [](double x, double) { return std::exp(x); }, -20, 20, 100, 0},
        {"exp2(x[1])", [](double x, double) { return std::exp2(x); }, -30, 30, 140, 0},
        {"log(x[1])", [](double x, double) { return std::log(x); }, 1e-3F, 100, 8, 0x1p-19},
        {"log2(x[1])", [](double x, double) { return std::log2(x); }, 1e-3F, 100, 8, 0x1p-19},
        {"pow(x[1], x[2])", [](double x, double y) { return std::pow(x, y); }, 0.01F, 4, 2000, 0},
        {"sin(x[1])", [](double x, double) { return std::sin(x); }, -9, 9, 0, 0x1p-8},
        {"cos(x[1])", [](double x, double) { return std::cos(x); }, -9, 9, 0, 0x1p-8},
        {"atan(x[1])", [](double x, double) { return std::atan(x); }, -9, 9, 8300, 0},
        {"atan(x[1], x[2])", [](double x, double y) { return std::atan2(x, y); }, 0.1F, 9, 8300, 0},
        {"asin(x[1])", [](double x, double) { return std::asin(x); }, -1, 1, 8300, 0x1p-8},
        {"acos(x[1])", [](double x, double) { return std::acos(x); }, -1, 1, 8300, 0x1p-8},
        {"sinh(x[1])", [](double x, double) { return std::sinh(x); }, -5, 5, 60, 0x1p-19},
        {"cosh(x[1])", [](double x, double) { return std::cosh(x); }, -5, 5, 60, 0},
        {"tanh(x[1])", [](double x, double) { return std::tanh(x); }, -5, 5, 10, 0x1p-18},
        {"asinh(x[1])", [](double x, double) { return std::asinh(x); }, -5, 5, 10, 0x1p-18},
        {"acosh(x[1])", [](double x, double) { return std::acosh(x); }, 1, 5, 10, 0x1p-8},
        {"atanh(x[1])", [](double x, double) { return std::atanh(x); }, -0.9F, 0.9F, 20, 0x1p-18},
        {"inversesqrt(x[1])", [](double x, double) { return 1.0 / std::sqrt(x); }, 0.01F, 9, 6, 0},
        {"sqrt(x[1])", [](double x, double) { return std::sqrt(x); }, 0.01F, 9, 12, 0},
        {"x[1] / x[2]", [](double x, double y) { return x / y; }, 0.01F, 9, 7, 0},
        {"mix(x[1], x[2], 0.25)", [](double x, double y) { return 0.75 * x + 0.25 * y; }, 0.01F, 9, 12, 0},
        {"smoothstep(0.0, 10.0, x[1])",
         [](double x, double) {
             x /= 10.0F;
             return x * x * (3.0 - 2.0 * x);
         },
         0.1F, 9, 40, 0},
        {"length(vec2(x[1], x[2]))", [](double x, double y) { return std::hypot(x, y); }, 0.1F, 9, 20, 0},
        {"length(vec3(x[1], x[2], 0.5))", [](double x, double y) { return std::hypot(x, y, 0.5); }, 0.1F, 9, 20, 0},
        {"normalize(vec4(x[1], x[2], 0.5, 1.0)).x",
         [](double x, double y) { return x / std::sqrt(x * x + y * y + 1.25); }, 0.1F, 9, 30, 0},
        {"dot(vec2(x[1], x[2]), vec2(0.3, 0.7))",
         [](double x, double y) { return x * double{0.3F} + y * double{0.7F}; }, 0.1F, 9, 10, 0},
        {"determinant(mat2(x[1], 0.1, 0.2, x[2]))",
         [](double x, double y) { return x * y - double{0.1F} * double{0.2F}; }, 1, 9, 12, 0},
        {"inverse(mat2(x[1], 0.0, 0.0, x[2]))[0][0]", [](double x, double) { return 1.0 / x; }, 1, 9, 30, 0}};
    std::mt19937 random(7);
    for (const Function& one : functions) {
        INFO(one.name);
        const Statements text("x[0] = " + one.name + ";");
        std::uniform_real_distribution<float> value(one.lowest, one.highest);
        for (int k = 0; k < 100; ++k) {
            const float x = value(random), y = value(random);
            const Interval set = text.set({0, x, y});
            INFO(x << ", " << y << ": " << set.low << " to " << set.high);
            REQUIRE_FALSE(set.any);
            const double exact = one.exact(x, y);
            REQUIRE(set.contains(static_cast<float>(exact)));
            REQUIRE((ulps(set) <= one.most_ulps || set.high - set.low <= one.most_absolute));
        }
    }
}

TEST_CASE("text outcomes: a comparison that rounding leaves open is two ways, with its line") {
    const std::string statements = "float y = x[1] * x[2];\nx[0] = y < x[3] ? 1.0 : 2.0;";
    const float a = 1.1F, b = 1.3F;
    const auto open = outcomes(statements, {0, a, b, a * b});
    REQUIRE(open.size() == 2);
    CHECK(open[0].written[0].set.as_float() != open[1].written[0].set.as_float());
    REQUIRE(open[0].open.size() == 1);
    CHECK(open[0].open[0].site == "kernel.comp:6");
    const auto sure = outcomes(statements, {0, a, b, 2.0F});
    REQUIRE(sure.size() == 1);
    CHECK(sure[0].written[0].set.as_float() == 1.0F);
}

TEST_CASE("text outcomes: floor, ceil, round, integers and packed words take each way that a set leaves open") {
    const std::string product = "float y = x[1] * x[2];\n"; // about 3, from both sides
    const float third = 1.0F / 3.0F;
    const std::vector<float> given{0, 9.0F, third};
    const auto values = [&](const std::string& statement) {
        std::vector<float> all;
        for (const text::InvocationOutcome& one : outcomes(product + statement, given)) {
            CHECK(one.undefined == Undefined::none);
            all.push_back(one.written.at(0).set.as_float());
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    CHECK(values("x[0] = floor(y);") == std::vector<float>{2, 3});
    CHECK(values("x[0] = ceil(y);") == std::vector<float>{3, 4});
    CHECK(values("x[0] = trunc(y);") == std::vector<float>{2, 3});
    CHECK(values("x[0] = round(y);") == std::vector<float>{3});
    CHECK(values("x[0] = float(int(y));") == std::vector<float>{2, 3});
    CHECK(values("x[0] = sign(y - 3.0);") == std::vector<float>{-1, 0, 1});
    CHECK(values("x[0] = round(2.5);").size() == 1); // a constant that the compiler folds
    CHECK(values("x[3] = round(0.5 * x[1] - 2.0);") == std::vector<float>{2, 3});
    CHECK(values("x[3] = roundEven(0.5 * x[1] - 2.0);") == std::vector<float>{2});
    CHECK(values("x[0] = float(packUnorm4x8(vec4(x[2] * 0.75)));").size() == 1);
}

TEST_CASE("text outcomes: a float's bits are a set until an integer operation asks for them") {
    const std::vector<float> given{0, 0.7F};
    const Interval sine = set_of("sin(x[1])", given);
    REQUIRE(ulps(sine) > 100);
    const Interval back =
        Statements("uint bits = floatBitsToUint(sin(x[1]));\nx[0] = uintBitsToFloat(bits);").set(given);
    CHECK(back.low == sine.low);
    CHECK(back.high == sine.high);

    const auto kept =
        outcomes("uint w[2];\nw[0] = floatBitsToUint(sin(x[1]));\nw[1] = 0u;\nx[0] = uintBitsToFloat(w[0]);", given);
    REQUIRE(kept.size() == 1);
    CHECK(kept[0].written[0].is_real);
    CHECK(kept[0].written[0].set.low == sine.low);

    // Of an integer operation that wants to know them each word is a way; of too many nothing is said.
    const auto ways = outcomes("x[0] = float(bitCount(floatBitsToUint(inversesqrt(x[1]))));", given);
    CHECK(ways.size() > 1);
    for (const text::InvocationOutcome& one : ways)
        CHECK(one.undefined == Undefined::none);
    const auto too_many = outcomes("x[0] = float(bitCount(floatBitsToUint(sin(x[1]))));", given);
    REQUIRE(too_many.size() == 1);
    CHECK(too_many[0].undefined == Undefined::undecided);
}

TEST_CASE("text outcomes: what was written is read back as a set, and what lies in memory stays") {
    const auto found = outcomes("x[0] = x[1] * x[2];\nx[3] = x[0] - x[1] * x[2];", {0, 1.1F, 1.3F});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].written.size() == 2);
    CHECK(found[0].written[1].set.contains(0.0F));
    CHECK_FALSE(found[0].written[1].set.is_point());
}

TEST_CASE("text outcomes: operands that may have no result leave the outcome undefined") {
    for (const char* expression :
         {"sqrt(x[1])", "log(x[1])", "pow(x[1], 0.5)", "asin(x[2])", "acosh(x[1])", "normalize(vec3(x[0])).x"}) {
        INFO(expression);
        CHECK(set_of(expression, {0, -1.0F, 1.5F}).any);
    }
}

TEST_CASE("text outcomes: an atomic operation whose result nothing uses leaves the rest of its invocation followed") {
    const std::string counter = "layout(std430, binding = 1) buffer Counter { uint number; uint others[]; };\n";
    const Statements text("x[0] = x[1] * x[2] + x[3]; atomicAdd(number, 7u);", counter);
    std::vector<std::uint32_t> words = words_of({0, 1.1F, 2.3F, 3.7F}), count{5, 0};
    text::Bindings bindings;
    bindings.blocks.emplace_back(words);
    bindings.blocks.emplace_back(count);
    const auto found = text.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].written.size() == 2);
    CHECK_FALSE(found[0].written[0].set.is_point());
    CHECK(found[0].written[1].place.space == text::WrittenPlace::Space::changed_block);
    CHECK(found[0].written[1].word == 7);
    CHECK(count == std::vector<std::uint32_t>{5, 0});
    for (const char* const statements :
         {"x[0] = float(atomicAdd(number, 1u));", "atomicAdd(number, 1u); x[0] = float(number);",
          "others[0] = 3u; atomicAdd(others[0], 1u);", "atomicAdd(others[0], 1u); others[0] = 3u;"}) {
        INFO(statements);
        const Statements refused(statements, counter);
        CHECK_THROWS_WITH(refused.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {}),
                          Contains("kernel.comp:6") && Contains("is not run apart from others"));
    }
}

TEST_CASE("text outcomes: a texel of codes or halves is either neighbour of what is stored, and no other") {
    struct Stored {
        std::string value;
        std::vector<std::uint32_t> codes; ///< that it may become
    };
    for (const Stored& one : {Stored{"x[1]", {51, 52}},
                              {"0.0", {0}},
                              {"1.0", {255}},
                              {"-3.0", {0}},
                              {"0.4999", {127, 128}},
                              {"127.0 * x[2]", {126, 127, 128}},
                              {"x[1] / 0.0 - x[1] / 0.0", {0, 128, 255}}}) {
        INFO(one.value);
        const Statements text("imageStore(codes, ivec2(0), vec4(" + one.value + ", 0.25, 0, 0));",
                              "layout(rgba8, binding = 0) uniform image2D codes;");
        std::vector<std::uint32_t> words = words_of({0, 0.2F, 1.0F / 255.0F}), codes(4);
        words.resize(16);
        text::Bindings bindings;
        bindings.blocks.emplace_back(words);
        bindings.images.push_back({.code = text::TexelMemory::Code::unorm8, .words = codes});
        const auto found = text.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {});
        REQUIRE(found.size() == 1);
        REQUIRE(found[0].written.size() == 4);
        for (std::uint32_t code = 0; code < 256; ++code) {
            const bool is_listed = std::find(one.codes.begin(), one.codes.end(), code) != one.codes.end();
            if (is_listed || one.codes.size() < 3)
                CHECK(found[0].written[0].may_be(code) == is_listed);
        }
        CHECK(found[0].written[1].may_be(63));
        CHECK(found[0].written[1].may_be(64));
        CHECK_FALSE(found[0].written[1].may_be(65));
    }
    const Statements halves("imageStore(halves, ivec2(0), vec4(x[1], 0.25, x[1] * x[1], 0));",
                            "layout(rgba16f, binding = 0) uniform image2D halves;");
    std::vector<std::uint32_t> words = words_of({0, 0.1F}), texel(4);
    words.resize(16);
    text::Bindings bindings;
    bindings.blocks.emplace_back(words);
    bindings.images.push_back({.code = text::TexelMemory::Code::half, .words = texel});
    const auto found = halves.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].written.size() == 4);
    CHECK(found[0].written[0].set.low == 0.0999755859375);
    CHECK(found[0].written[0].set.high == 0.10003662109375);
    CHECK(found[0].written[1].set.is_point());
    CHECK_FALSE(found[0].written[2].may_be(std::bit_cast<std::uint32_t>(0.02F)));
}

TEST_CASE("text outcomes: texture() at an open place is each texel that it may lie in, or has weights that are sets") {
    const Statements text("x[0] = texture(image, vec2(x[1] * x[2], 0.5)).r;", "uniform sampler2D image;");
    const auto of = [&](float a, float b, text::TexelMemory::Filter filter) {
        std::vector<std::uint32_t> words = words_of({0, a, b}), texels = words_of({1.0F, 2.0F, 4.0F, 8.0F});
        words.resize(16);
        text::Bindings bindings;
        bindings.blocks.emplace_back(words);
        bindings.images.push_back({.size = {4, 1, 1}, .components = 1, .filter = filter, .words = texels});
        return text.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {});
    };
    using Filter = text::TexelMemory::Filter;
    const auto inside = of(1.1F, 0.3F, Filter::nearest); // 0.33, in the second of four
    REQUIRE(inside.size() == 1);
    CHECK(inside[0].written[0].set.is_point());
    CHECK(inside[0].written[0].set.as_float() == 2.0F);
    const auto border = of(0.1F, 2.5F, Filter::nearest); // 0.25 and a little
    REQUIRE(border.size() == 2);
    CHECK(border[0].written[0].set.low + border[1].written[0].set.low == 3.0);
    const auto between = of(1.1F, 0.5F, Filter::linear); // 0.55, 0.7 of the way from the second's centre to the third's
    REQUIRE(between.size() == 1);
    const Interval set = between[0].written[0].set;
    CHECK(set.contains(3.4F));
    CHECK(set.high - set.low < 1e-5);
    CHECK_FALSE(set.contains(3.4001F));
    const auto centre = of(0.1F, 3.75F, Filter::linear); // 0.375, the second's centre
    for (const text::InvocationOutcome& one : centre) {
        CHECK(one.written[0].set.low > 1.999);
        CHECK(one.written[0].set.high < 2.001);
    }
    CHECK(centre.size() == 2);
}

TEST_CASE("text outcomes: what is read back of a texel of codes is refused by its line") {
    const Statements text("imageStore(codes, ivec2(0), vec4(x[1])); x[0] = imageLoad(codes, ivec2(0)).x;",
                          "layout(rgba8, binding = 0) uniform image2D codes;");
    std::vector<std::uint32_t> words = words_of({0, 0.2F}), codes(4);
    text::Bindings bindings;
    bindings.blocks.emplace_back(words);
    bindings.images.push_back({.code = text::TexelMemory::Code::unorm8, .words = codes});
    CHECK_THROWS_WITH(text.of.of({}, {1, 1, 1}, bindings, PassStage::compute, named_profile("strict"), {}),
                      Contains("kernel.comp:5") && Contains("reads what it wrote of a half or rgba8 image"));
}

TEST_CASE("text outcomes: what invocations share is refused by its line") {
    CHECK_THROWS_WITH(outcomes("atomicAdd(n, 1);", {0}, {}, "shared int n;"),
                      Contains("kernel.comp:5") && Contains("is not run apart from others"));
}

TEST_CASE("text outcomes: isnan and isinf are known of numbers that are open") {
    CHECK(set_of("isinf(x[1] / x[2]) || isnan(x[1] / x[2]) ? 5.0 : 1.0", {0, 1.0F, 3.0F}).high == 1.0);
    CHECK(set_of("isinf(x[1] / x[2] * 1e38) ? 5.0 : 1.0", {0, 12.0F, 3.0F}).low == 5.0);
}

TEST_CASE("text outcomes: an integer made of an open float's bits is as open as the float is") {
    // exp2 by its bits: 2^3 times a sum that may be fused.
    const Interval sum = set_of("x[1] * x[2] + x[3]", {0, 1.1F, 0.9F, 0.5F});
    const Interval scaled =
        set_of("intBitsToFloat(floatBitsToInt(x[1] * x[2] + x[3]) + (3 << 23))", {0, 1.1F, 0.9F, 0.5F});
    REQUIRE(sum.low < sum.high);
    CHECK(scaled.low == 8.0 * double{static_cast<float>(sum.low)});
    CHECK(scaled.high == 8.0 * double{static_cast<float>(sum.high)});
    // A root by halves of the exponent, whose set has too many floats for a way each.
    const std::string square = "exp(x[1])";
    const Interval wide = set_of(square, {0, 30.5F});
    const Interval root = set_of("uintBitsToFloat((floatBitsToUint(" + square + ") >> 1) + 0x1fbd1df5u)", {0, 30.5F});
    const auto halved = [](double x) {
        return double{std::bit_cast<float>((std::bit_cast<std::uint32_t>(static_cast<float>(x)) >> 1U) + 0x1fbd1df5U)};
    };
    REQUIRE(ulps(wide) > 16);
    CHECK(root.low == halved(wide.low));
    CHECK(root.high == halved(wide.high));
    CHECK(set_of("intBitsToFloat(floatBitsToInt(" + square + ") ^ 0x80000000)", {0, 30.5F}).low == -wide.high);
    const Interval number = set_of("float(floatBitsToUint(" + square + "))", {0, 30.5F});
    CHECK(number.contains(static_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(wide.low)))));
    CHECK(number.contains(static_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(wide.high)))));
}

TEST_CASE("text outcomes: an open integer decides a branch both ways only where it lies on both sides") {
    const std::string bits = "uint b = floatBitsToUint(exp(x[1]));\n";
    CHECK(set_of("0.0;\n" + bits + "if (b > 5u) x[0] = 1.0", {0, 30.5F}).low == 1.0);
    const Interval wide = set_of("exp(x[1])", {0, 30.5F});
    const auto middle = static_cast<float>(0.5 * (wide.low + wide.high));
    const auto ways = outcomes(bits + "x[0] = b > floatBitsToUint(x[2]) ? 1.0 : 2.0;", {0, 30.5F, middle});
    REQUIRE(ways.size() == 2);
    CHECK(ways[0].written[0].set.low + ways[1].written[0].set.low == 3.0);
}

TEST_CASE("text outcomes: an open integer that is written may be each of its words and no other") {
    const auto found = outcomes("y[0] = floatBitsToInt(exp(x[1])) + 1;", {0, 30.5F}, {},
                                "layout(std430, binding = 1) buffer Y { int y[]; };");
    REQUIRE(found.size() == 1);
    const Interval wide = set_of("exp(x[1])", {0, 30.5F});
    const auto first = std::bit_cast<std::uint32_t>(static_cast<float>(wide.low)),
               last = std::bit_cast<std::uint32_t>(static_cast<float>(wide.high));
    const text::WrittenWord& word = found[0].written[0];
    CHECK(word.may_be(first + 1));
    CHECK(word.may_be(last + 1));
    CHECK_FALSE(word.may_be(first));
    CHECK_FALSE(word.may_be(last + 2));
    CHECK(word.set_in(Scalar::int32).low == first + 1.0);
    CHECK(word.set_in(Scalar::int32).high == last + 1.0);
    CHECK(word.set_in(Scalar::float32).contains(std::bit_cast<float>(first + 1)));
}

TEST_CASE("text outcomes: an open float's bits that an operation has chosen are written as they were chosen") {
    const auto found = outcomes("uint b = floatBitsToUint(inversesqrt(x[1]));\n"
                                "x[0] = float(bitCount(b));\ny[0] = b;",
                                {0, 0.7F}, {}, "layout(std430, binding = 1) buffer Y { uint y[]; };");
    REQUIRE(found.size() > 1);
    for (const text::InvocationOutcome& one : found)
        for (const text::WrittenWord& word : one.written) {
            CHECK((word.is_real ? word.set.is_point() : word.more == 0));
        }
}

} // namespace lockstep::test::outcomes_test
