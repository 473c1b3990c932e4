#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/text/examine.hpp"
#include "crosscheck/text/open_constants.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::examine_test {

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

const std::string of_eight = "layout(local_size_x = 8) in;\n";

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

TEST_CASE("examine: two images of one unit are one image, and are refused where they are of two formats") {
    const auto text = [&](const std::string& second) {
        return of_eight + "layout(binding = 1, r32f) uniform image2D a;\nlayout(" + second +
               (second.back() == 'y' ? "" : ")") +
               " uniform image2D b;\n"
               "void main() { ivec2 at = ivec2(gl_LocalInvocationIndex, 0);\n"
               "imageStore(a, at, vec4(1.0));\n"
               "imageStore(b, ivec2(7 - at.x, 0), vec4(2.0)); }\n";
    };
    const Examination one{.groups = {1, 1, 1}};
    CHECK(found(text("binding = 1, r32f"), one) == Lines{"6 5 race on an image"});
    CHECK(found(text("binding = 2, r32f"), one).empty());
    CHECK(found(text("binding = 1) writeonly"), one) == Lines{"6 5 race on an image"});
    CHECK_THROWS_WITH(examined(text("binding = 1, rgba32f"), one),
                      Contains("images a and b are on one unit, 1; expected one type, one size and one format"));
    // What one writes the other reads.
    CHECK(found(of_eight +
                    "layout(binding = 1, r32f) uniform image2D a;\nlayout(binding = 1, r32f) uniform image2D b;\n"
                    "buffer Out { float x[]; };\n"
                    "void main() { ivec2 at = ivec2(gl_LocalInvocationIndex, 0);\n"
                    "imageStore(a, at, vec4(-1.0));\n"
                    "x[at.x] = sqrt(imageLoad(b, at).x); }\n",
                one) == Lines{"7 sqrt of a negative number"});
    // Elements of one array are not.
    CHECK(found(of_eight + "layout(binding = 1) buffer B { float x[]; } b[2];\n"
                           "void main() { uint i = gl_LocalInvocationIndex;\n"
                           "b[0].x[i] = 1.0;\nb[1].x[7u - i] = 2.0; }\n",
                one)
              .empty());
}

TEST_CASE("examine: what groups hand on by an atomic operation has to be coherent") {
    const auto text = [&](const std::string& writing, const std::string& reading) {
        return of_eight + "layout(binding = 0) " + writing + "buffer A { float parts[]; };\nlayout(binding = 0) " +
               reading +
               "buffer B { float sums[]; };\n"
               "layout(binding = 1) buffer Count { uint done; };\nlayout(binding = 2) buffer Out { float total; };\n"
               "shared bool is_last;\n"
               "void main() {\n"
               "if (gl_LocalInvocationIndex == 0u) {\n"
               "parts[gl_WorkGroupID.x] = 1.0;\n"
               "memoryBarrierBuffer();\n"
               "is_last = atomicAdd(done, 1u) + 1u == gl_NumWorkGroups.x; }\n"
               "barrier();\n"
               "if (is_last && gl_LocalInvocationIndex == 0u)\n"
               "for (uint g = 0u; g < gl_NumWorkGroups.x; ++g)\n"
               "total += sums[g]; }\n";
    };
    const Lines missing{"15 9 memory that groups hand on without `coherent`"};
    CHECK(found(text("coherent ", "coherent ")).empty());
    CHECK(found(text("volatile ", "coherent ")).empty());
    CHECK(found(text("", "coherent ")) == missing);
    CHECK(found(text("coherent ", "")) == missing);
    CHECK(found(text("", "")) == missing);
    // Of one group, and of atomic operations alone, nothing is said.
    CHECK(found(text("", ""), {.groups = {1, 1, 1}}).empty());
    CHECK(found(of_eight +
                "buffer Count { uint n; };\nvoid main() { atomicAdd(n, 1u); memoryBarrier(); atomicMax(n, 2u); }\n")
              .empty());
}

TEST_CASE("examine: a loop that waits for another invocation, and one that does not end, are found at once") {
    const auto begun = std::chrono::steady_clock::now();
    const std::string lock = of_eight + "coherent buffer Lock { uint lock; };\ncoherent buffer Out { float x[]; };\n";
    const std::string waits = "loop that waits for another invocation", endless = "loop that does not end";
    CHECK(found(lock + "void main() {\n"
                       "while (atomicCompSwap(lock, 0u, 1u) != 0u);\n"
                       "x[0] += 1.0; memoryBarrierBuffer(); atomicExchange(lock, 0u); }\n") == Lines{"5 " + waits});
    CHECK(found("layout(local_size_x = 1) in;\ncoherent buffer Flags { uint ready[]; };\nvoid main() { uint g = "
                "gl_WorkGroupID.x;\n"
                "while (g < 3u && atomicAdd(ready[g + 1u], 0u) == 0u) {}\n"
                "atomicExchange(ready[g], 1u); }\n") == Lines{"4 " + waits});
    // Earlier groups run first here; none has to.
    const std::string handed = "layout(local_size_x = 1) in;\ncoherent buffer Flags { uint ready[]; };\n"
                               "coherent buffer Out { float x[]; };\nvoid main() { uint g = gl_WorkGroupID.x;\n";
    CHECK(found(handed + "if (g > 0u) while (atomicAdd(ready[g - 1u], 0u) == 0u);\n"
                         "x[g + 1u] = x[g] + 1.0; memoryBarrierBuffer();\n"
                         "atomicExchange(ready[g], 1u); }\n",
                {.sizes = {{"Out", {8}}}}) == Lines{"5 " + waits});
    CHECK(found(handed +
                    "if (g > 0u && atomicAdd(ready[g - 1u], 0u) == 1u) x[g + 1u] = x[g] + 1.0; else x[g + 1u] = 1.0;\n"
                    "memoryBarrierBuffer(); atomicExchange(ready[g], 1u); }\n",
                {.sizes = {{"Out", {8}}}})
              .empty());
    CHECK(found_in("while (true) { }") == Lines{"4 " + endless});
    CHECK(found_in("int i = 0;\nfor (;;) ++i;") == Lines{"5 " + endless});
    CHECK(found_in("int i = 0;\nwhile (i < 3) { if (x[0] > 4.0) ++i; }").front().ends_with(waits));
    CHECK(found_in("int i = 0;\nwhile (i < 3) { if (n > 4) ++i; }", "uniform int n;") == Lines{"5 " + endless});
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(60));
    // Long loops end.
    CHECK(
        found_in("int n = 0;\nfor (int i = 0; i < 20000; ++i) if (x[i % 7] > 2.0) ++n;\nx[0] = float(n);", "").empty());
    CHECK(found(of_eight + "shared uint n;\nvoid main() { uint i = gl_LocalInvocationIndex; if (i == 0u) n = 0u;\n"
                           "barrier();\nuint k = 0u;\nfor (;;) { barrier(); if (n == 1u) break; barrier();\n"
                           "if (i == 7u && ++k == 6000u) n = 1u; } }\n",
                {.groups = {1, 1, 1}})
              .empty());
    CHECK(found(lock + "void main() {\n"
                       "for (bool done = false; !done;) if (atomicCompSwap(lock, 0u, 1u) == 0u) {\n"
                       "x[0] += 1.0; memoryBarrierBuffer(); atomicExchange(lock, 0u); done = true; } }\n")
              .empty());
}

TEST_CASE("examine: blocks, members and images hold what --fill says, and a race that it ends names it") {
    const std::string text = of_eight + "buffer Indices { uint skipped; uint at[]; };\nbuffer Out { float x[]; };\n"
                                        "void main() { uint i = gl_GlobalInvocationID.x;\n"
                                        "x[at[i]] = 1.0; }\n";
    const auto with = [&](const std::string& name, const std::string& value) {
        return Examination{.groups = {1, 1, 1}, .fills = {{name, value}}};
    };
    CHECK(found(text) == Lines{"5 5 race on a buffer"});
    const ExaminationResult race = examined(text);
    CHECK_THAT(race.findings.front().found.what, Contains("(not with --fill Indices.at=iota)"));
    CHECK(found(text, with("Indices", "iota")).empty());
    CHECK(found(text, with("Indices.at", "iota")).empty());
    CHECK(found(text, with("Indices.at", "zero")) == Lines{"5 5 race on a buffer"});
    CHECK(found(text, with("Indices.skipped", "iota")) == Lines{"5 5 race on a buffer"});
    CHECK_THAT(found(text, with("Indices.at", "1000")).front(), Contains("access outside of a buffer"));
    CHECK_THROWS_WITH(
        examined(text, with("Index", "iota")),
        Contains("--fill Index: the shader has no such name; it has Out, Out.x, Indices, Indices.skipped, Indices.at"));
    CHECK_THROWS_WITH(examined(text, with("Indices.at", "many")),
                      Contains("--fill Indices.at: expected iota, zero or a number; 'many' is no "));
    const std::string structures = of_eight + "struct P { vec2 place; int other; };\nbuffer Grains { P p[]; } grains;\n"
                                              "buffer Out { float x[]; };\n"
                                              "void main() { uint i = gl_GlobalInvocationID.x;\n"
                                              "x[grains.p[i].other] = log(grains.p[i].place.y); }\n";
    CHECK(found(structures, with("Grains.p.other", "iota")).empty());
    CHECK(found(structures, with("Grains.p.place", "iota")) == Lines{"6 6 race on a buffer"});
    CHECK(found(structures, {.groups = {1, 1, 1}, .fills = {{"Grains.p.other", "iota"}, {"Grains.p.place", "zero"}}}) ==
          Lines{"6 log of 0 or less"});
    // A race that does not rest on them has no such words.
    CHECK_THAT(examined(of_eight + "buffer Indices { uint at[]; };\nbuffer Out { float x[]; };\n"
                                   "void main() { x[at[0]] = 1.0; }\n")
                   .findings.front()
                   .found.what,
               !Contains("--fill"));
    const std::string image = of_eight +
                              "layout(r32i) uniform iimage1D places;\nbuffer Out { float x[]; };\n"
                              "void main() { x[imageLoad(places, int(gl_GlobalInvocationID.x)).x] = 1.0; }\n";
    CHECK_THAT(examined(image).findings.front().found.what, Contains("(not with --fill places=iota)"));
    CHECK(found(image, with("places", "iota")).empty());
}

TEST_CASE("examine: an atomic operation outside of an image gives 0 and leaves it as it is") {
    CHECK(found(of_eight +
                "layout(r32ui) uniform uimage2D a;\nbuffer Out { float x[]; };\n"
                "void main() { uint i = gl_GlobalInvocationID.x; imageAtomicExchange(a, ivec2(i, 0), 5u);\n"
                "uint outside = imageAtomicAdd(a, ivec2(i, -1), 7u) + imageAtomicMax(a, ivec2(1000, 0), 7u);\n"
                "x[i] = sqrt(outside == 0u ? 1.0 : -1.0) + float(imageAtomicAdd(a, ivec2(i, 0), 0u)); }\n")
              .empty());
}

TEST_CASE("examine: a shared variable that begins as 0 is set") {
    const std::string group = "#extension GL_EXT_null_initializer : enable\n" + of_eight;
    const std::string body = "buffer Out { float x[]; };\n"
                             "void main() { x[gl_GlobalInvocationID.x] = s[gl_LocalInvocationIndex]; }\n";
    const Examination of_groups{.groups = {1, 1, 1}, .sizes = {{"Out", {8}}}};
    CHECK(found(group + "shared float s[8] = {};\n" + body, of_groups).empty());
    CHECK(found(group + "shared float s[8];\n" + body, of_groups).size() == 1);
}

} // namespace lockstep::test::examine_test
