#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/text/examine.hpp"
#include "crosscheck/text/open_constants.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
using namespace lockstep::test;
using Catch::Contains;

namespace {

using Lines = std::vector<std::string>;

ExaminationResult examined(const std::string& text, Examination of = {}) {
    const TemporaryFolder folder;
    of.file = folder.write("kernel.comp", "#version 450\n" + text);
    return examine(of);
}

/// "LINE rule", or "LINE LINE rule" of two places; the text's lines count from 1.
Lines found(const std::string& text, const Examination& of = {}) {
    Lines all;
    for (const NamedFinding& one : examined(text, of).findings) {
        std::string line = std::to_string(one.found.place.line - 1) + " ";
        if (one.found.other)
            line += std::to_string(one.found.other->line - 1) + " ";
        all.push_back(line + one.found.rule.substr(0, one.found.rule.find(" (")));
    }
    return all;
}

/// Statements from line 3 on, in one invocation of one group.
Lines found_in(const std::string& statements, const std::string& declarations = "") {
    return found("layout(local_size_x = 1) in; buffer Out { float x[]; };\n" + declarations + "\nvoid main() {\n" +
                     statements + "\n}\n",
                 {.groups = {1, 1, 1}, .sizes = {{"Out", {8}}}});
}

} // namespace

TEST_CASE("examine: operands of constant expressions are looked at though a compiler folds them") {
    const auto finds = [&](const std::string& wrong, const std::string& right, const std::string& rule) {
        INFO(wrong);
        CHECK(found_in("\n" + wrong) == Lines{"5 " + rule});
        INFO(right);
        CHECK(found_in("\n" + right).empty());
    };
    const std::string shift = "shift by a negative count, or by 32 or more", division = "division of integers by 0";
    finds("x[0] = pow(-2.0, 2.0);", "x[0] = pow(2.0, -2.0);", "pow of a negative base, or of 0 to no positive power");
    finds("x[0] = sqrt(-1.0);", "x[0] = sqrt(1.0);", "sqrt of a negative number");
    finds("x[0] = float(1 / 0);", "x[0] = float(0 / 1);", division);
    finds("x[0] = float(7 % 0);", "x[0] = float(7 % 2);", "% of a negative operand, or by 0");
    finds("x[0] = float(1 << 40);", "x[0] = float(1 << 4);", shift);
    finds("x[0] = float(8u >> 32u);", "x[0] = float(8u >> 31u);", shift);
    finds("x[0] = asin(2.0);", "x[0] = asin(1.0);", "asin or acos beyond 1");
    finds("x[0] = normalize(vec3(0)).x;", "x[0] = normalize(vec3(1, 0, 0)).x;", "normalize of a vector of length 0");
    finds("x[0] = clamp(x[1], 1.0, 0.0) + clamp(0.5, 1.0, 0.0);", "x[0] = clamp(0.5, 0.0, 1.0);",
          "clamp with a minimum above its maximum");
    finds("x[0] = float(clamp(3, 1, 0));", "x[0] = float(clamp(3, 0, 1));", "clamp with a minimum above its maximum");
    finds("x[0] = smoothstep(1.0, 0.0, 0.5);", "x[0] = smoothstep(0.0, 1.0, 0.5);",
          "smoothstep whose edges are equal or reversed");
    finds("x[0] = log2(0.0);", "x[0] = log2(0.5);", "log of 0 or less");
    finds("x[0] = atan(0.0, 0.0);", "x[0] = atan(0.0);", "atan(0, 0)");
    finds("x[0] = mod(1.0, 0.0);", "x[0] = mod(1.0, 0.5);", "mod by 0");
    finds("x[0] = float(int(3e9));", "x[0] = float(int(-2e9));",
          "conversion of a float that the integer type does not have");
    finds("x[0] = float(ivec2(1.0, 3e9).y);", "x[0] = float(ivec2(1.5, 3).y);",
          "conversion of a float that the integer type does not have");
    finds("x[0] = max(0.0 / 0.0, 1.0);", "x[0] = max(1.0 / 2.0, 1.0);", "min, max or clamp of NaN");
    finds("x[0] = inversesqrt(sqrt(0.0));", "x[0] = inversesqrt(sqrt(4.0));", "inversesqrt of 0 or less");
    finds("const int zero = 3 - 3; x[0] = float(1 / zero);", "const int one = 3 - 2; x[0] = float(1 / one);", division);
    finds("const float k = sqrt(-1.0), l = 2.0; x[0] = k;", "const float k = sqrt(2.0); x[0] = k;",
          "sqrt of a negative number");
    finds("x[0] = float(5 / (2 - 2));", "x[0] = float(5 / (2 - 3));", division);
    // Of what does not run nothing is said.
    CHECK(found_in("if (x[0] > 2.0) x[1] = sqrt(-1.0);").empty());
}

TEST_CASE("examine: constants are constants still where the text needs some") {
    CHECK(found_in("float a[n / 2]; a[0] = 1.0; switch (int(x[0])) { case 8 / 4: x[1] = 1.0; } x[0] = a[0] + t[1 % 2];",
                   "const int n = 9 % 5; const float t[2] = float[](sqrt(2.0), pow(2.0, 3.0));")
              .empty());
    CHECK(found_in("x[0] = t[1];", "const float t[2] = float[](sqrt(2.0),\n    pow(-2.0, 3.0));") ==
          Lines{"3 pow of a negative base, or of 0 to no positive power"});
    CHECK(
        found_in("x[0] = half_of(1) + float(N);", "#define N (7 / 0)\nfloat half_of(int n) { return float(n / 2); }") ==
        Lines{"5 division of integers by 0"});
    CHECK(found_in("x[0] = mod(7.0);", "float mod(float a) { return a / 2.0; }").empty());
    CHECK(found_in("x[0] = u + textureOffset(s, vec2(0.5), ivec2(1 % 2, 1.5)).x;",
                   "uniform sampler2D s; uniform int u = 7 % 2;")
              .empty());
    CHECK(!with_open_constants("#version 450\nvoid main() { float x = pow(y, 2.0); int n = m / 2; }\n", false, {}));
    const std::string text = "#version 450\n\nconst int n = 1 /\n    0, m = 7;\nvoid main() { int k = 1 << 40; }\n";
    const std::string open = with_open_constants(text, false, {}).value_or("");
    CHECK(std::count(open.begin(), open.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
    CHECK_THAT(open, Contains("const int n = 1 /     0, m = 7; ") && Contains("1 << lockstep_given(40)"));
}
