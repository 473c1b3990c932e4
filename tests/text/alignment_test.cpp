#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "reference/model/error.hpp"
#include "reference/text/alignment.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::alignment_test {

namespace {

/// A text of `statements` on `float x[]`, whose first statement is at line 6 of what is compiled.
struct Text {
    explicit Text(const std::string& statements, const std::string& declarations = "")
        : kernel("layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n" +
                 declarations + "\nvoid main() {\n" + statements + "\n}\n") {}

    [[nodiscard]] text::TracedRun run(const std::vector<float>& given,
                                      std::span<const text::ForcedRow> forced = {}) const {
        std::vector<std::uint32_t> words = words_of(given);
        words.resize(16);
        const std::vector<std::uint32_t> before = words;
        text::Bindings bindings;
        bindings.blocks.emplace_back(words);
        text::TracedRun run;
        run.words =
            text::run_traced(kernel.program, {}, {1, 1, 1}, bindings, named_profile("strict"), forced, run.trace);
        CHECK(words == before);
        return run;
    }
    TextKernel kernel;
};

struct Suspected {
    std::uint32_t line = 0;
    bool repairs = false;
};

std::vector<Suspected> suspects(const std::string& wrong, const std::string& right, const std::vector<float>& given) {
    const Text of_wrong(wrong), of_right(right);
    const text::TracedRun run = of_wrong.run(given);
    std::vector<Suspected> all;
    for (const text::Suspect& one :
         text::suspects_of(run, of_right.run(given),
                           [&](std::span<const text::ForcedRow> forced) { return of_wrong.run(given, forced).words; }))
        all.push_back({run.trace.rows[one.row].line, one.repairs});
    return all;
}

const std::string right = "float a = x[1] * 1.5;\n"
                          "float b = a + x[2];\n"
                          "if (b < x[3])\n"
                          "    b = b * 0.25;\n"
                          "x[0] = b * b + a;";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

} // namespace

TEST_CASE("alignment: the line that has no counterpart is the one that was changed, and its right value repairs") {
    struct Change {
        std::string what, by;
        std::uint32_t line;
    };
    for (const Change& one : {Change{"x[1] * 1.5", "x[1] * 1.25", 6}, Change{"a + x[2]", "a - x[2]", 7},
                              Change{"b * 0.25", "b * 0.5", 9}, Change{"x[1] * 1.5", "x[2] * 1.5", 6}}) {
        INFO(one.by);
        const std::vector<Suspected> found = suspects(replaced(right, one.what, one.by), right, {0, 1.7F, 2.3F, 100});
        REQUIRE_FALSE(found.empty());
        CHECK(found.front().line == one.line);
        CHECK(found.front().repairs);
    }
}

TEST_CASE("alignment: a comparison of other numbers is repaired by its other answer") {
    const std::vector<Suspected> found =
        suspects(replaced(right, "b < x[3]", "b < x[4]"), right, {0, 1.7F, 2.3F, 100, 1});
    const bool is_there =
        std::any_of(found.begin(), found.end(), [](const Suspected& one) { return one.line == 8 && one.repairs; });
    CHECK(is_there);
}

TEST_CASE(
    "alignment: a right value in the wrong place is its store, and what is never computed is a row of the other") {
    const std::vector<Suspected> found =
        suspects(replaced(right, "x[0] = b * b + a", "x[0] = a"), right, {0, 1.7F, 2.3F, 100});
    REQUIRE(found.size() == 1);
    CHECK(found[0].line == 10);
    const Text without(replaced(right, "    b = b * 0.25;", "    ;")), whole(right);
    const std::vector<float> given{0, 1.7F, 2.3F, 100};
    const text::TracedRun run = whole.run(given);
    const std::vector<std::uint32_t> missing = text::missing_rows(run, without.run(given));
    REQUIRE_FALSE(missing.empty());
    CHECK(run.trace.rows[missing.front()].line == 9);
}

TEST_CASE("alignment: texts that are written otherwise and write the same have no words that differ") {
    const std::vector<float> given{0, 1.7F, 2.3F, 100};
    CHECK(Text(right).run(given).words == Text(replaced(right, "b * b + a", "a + b * b")).run(given).words);
    CHECK(text::unmatched_rows(Text(right).run(given), Text(right).run(given)).empty());
}

TEST_CASE("trace: a row of a function has the lines of the calls around it") {
    const Text text("x[0] = outer(x[1]);",
                    "float inner(float v) { return v * 3.0; } float outer(float v) { for (int i = 0; "
                    "i < 2; ++i) v = inner(v); return v; }");
    const text::TracedRun run = text.run({0, 1.5F});
    bool is_found = false;
    for (const text::TraceRow& row : run.trace.rows)
        if (row.op == spv::OpFMul) {
            is_found = true;
            CHECK(text::lines_of(text.kernel.program, run.trace, row) == std::vector<std::uint32_t>{4, 4, 6});
        }
    CHECK(is_found);
}

TEST_CASE("alignment: the operand of an atomic operation is a word of its invocation") {
    const std::string right = "float a = x[1] * 1.5;\natomicAdd(n[1], uint(a));\nx[0] = a;";
    const std::string counters = "layout(std430, binding = 1) buffer Counters { uint n[4]; };";
    const auto run_of = [&](const std::string& statements, std::span<const text::ForcedRow> forced) {
        const Text text(statements, counters);
        std::vector<std::uint32_t> words = words_of({0, 4}), numbers{1, 2, 3, 4};
        text::Bindings bindings;
        bindings.blocks.emplace_back(words);
        bindings.blocks.emplace_back(numbers);
        text::TracedRun run;
        run.words =
            text::run_traced(text.kernel.program, {}, {1, 1, 1}, bindings, named_profile("strict"), forced, run.trace);
        CHECK(numbers == std::vector<std::uint32_t>{1, 2, 3, 4});
        return run;
    };
    for (const auto& [what, by] : {std::pair{"uint(a)", "uint(a) + 1u"}, {"n[1]", "n[2]"}}) {
        const std::string wrong = replaced(right, what, by);
        const text::TracedRun of_wrong = run_of(wrong, {});
        const auto found = text::suspects_of(of_wrong, run_of(right, {}), [&](std::span<const text::ForcedRow> forced) {
            return run_of(wrong, forced).words;
        });
        INFO(by);
        REQUIRE_FALSE(found.empty());
        CHECK(of_wrong.trace.rows[found.front().row].line == 7);
    }
}

TEST_CASE("trace: an invocation that shares what it computes is refused by its line") {
    CHECK_THROWS_WITH(Text("s = 1.0; barrier(); x[0] = s;", "shared float s;").run({0}),
                      Catch::Contains("kernel.comp:5") && Catch::Contains("is not run apart from others"));
}

} // namespace lockstep::test::alignment_test
