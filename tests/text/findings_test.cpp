#include <catch2/catch.hpp>

#include "tests/text/text_kernel.hpp"

namespace lockstep::test::findings_test {

namespace {

/// What a watched run of a kernel over 64 floats finds: "LINE rule".
std::vector<std::string> found(const std::string& text, std::array<std::uint32_t, 3> groups = {1, 1, 1},
                               std::vector<float> given = {}) {
    TextKernel kernel(text);
    given.resize(256);
    for (const text::Block& block : kernel.program.blocks)
        kernel.blocks[block.name] = words_of(given);
    for (const text::ImageUniform& image : kernel.program.images)
        kernel.images[image.name] = {{.size = {8, 8, 1}, .components = 1}, std::vector<std::uint32_t>(64)};
    kernel.is_watched = true;
    kernel.run(groups);
    std::vector<std::string> all;
    for (const text::Finding& one : kernel.findings.all())
        all.push_back(std::to_string(one.place.line - 1) + " " + one.rule.substr(0, one.rule.find(" (")));
    return all;
}

/// The same of statements from line 3 on, in one invocation; x[] holds `given`.
std::vector<std::string> found_in(const std::string& statements, std::vector<float> given = {}) {
    return found(
        "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; }; void main() {\n" +
            statements + "\n}\n",
        {1, 1, 1}, std::move(given));
}
using Lines = std::vector<std::string>;

} // namespace

TEST_CASE(
    "text findings: operands that GLSL gives no result are found with their line, and those beside them are not") {
    const std::vector<float> x{-2.0F, 0.5F, 0.0F, 40.0F, 3.0e9F, -5.0F, 1.5F};
    const auto finds = [&](const std::string& wrong, const std::string& right, const std::string& rule) {
        INFO(wrong);
        CHECK(found_in("\n" + wrong, x) == Lines{"4 " + rule});
        INFO(right);
        CHECK(found_in("\n" + right, x).empty());
    };
    finds("x[8] = pow(x[0], x[1]);", "x[8] = pow(x[1], x[0]);", "pow of a negative base, or of 0 to no positive power");
    finds("x[8] = smoothstep(x[1], x[0], 0.2);", "x[8] = smoothstep(x[0], x[1], 0.2);",
          "smoothstep whose edges are equal or reversed");
    finds("x[8] = float(1 << int(x[3]));", "x[8] = float(1 << int(x[6]));",
          "shift by a negative count, or by 32 or more");
    finds("x[8] = float(8 >> int(x[0]));", "x[8] = float(8 >> int(x[1]));",
          "shift by a negative count, or by 32 or more");
    finds("x[8] = float(int(x[4]));", "x[8] = float(uint(x[4]));",
          "conversion of a float that the integer type does not have");
    finds("x[8] = float(uint(x[0]));", "x[8] = float(int(x[0]));",
          "conversion of a float that the integer type does not have");
    finds("x[8] = float(uint(x[0] * 0.25));", "x[8] = float(uint(x[0] * 0.0));",
          "conversion of a float that the integer type does not have");
    finds("x[8] = float((-2147483647 - 1) / int(x[0] + 1.0));", "x[8] = float(-2147483647 / int(x[0] + 1.0));",
          "division of the least int by -1");
    finds("x[8] = inverse(mat3(x[0], x[1], 1.0, x[0], x[1], 2.0, x[0], x[1], 5.0))[0][0];",
          "x[8] = inverse(mat3(x[0], x[1], 1.0, x[1], x[1], 2.0, x[0], x[6], 5.0))[0][0];",
          "inverse of a singular matrix");
    finds("x[8] = ldexp(x[6], int(x[3]) + 88);", "x[8] = ldexp(x[6], int(x[3]) + 87);",
          "ldexp beyond what a float can be");
    finds("int e; x[8] = frexp(1.0 / x[2], e);", "int e; x[8] = frexp(x[6], e);", "frexp of infinity or NaN");
    finds("int e; float y = frexp(1.0 / x[2], e); x[8] = float(e);", "int e; x[8] = frexp(x[6], e) + float(e);",
          "frexp of infinity or NaN");
    // What nothing depends on is none.
    finds("x[8] = mix(1.0, log(x[0]), x[0] < 0.0);", "x[8] = mix(1.0, log(x[0]), x[0] > 0.0);", "log of 0 or less");
    finds("x[8] = min(x[2] / x[2], 1.0);", "x[8] = min(x[1] / x[1], 1.0);", "min, max or clamp of NaN");
    finds("x[8] = clamp(x[1], x[3], x[2]);", "x[8] = clamp(x[1], x[2], x[3]);",
          "clamp with a minimum above its maximum");
    finds("x[8] = float(7 / int(x[2]));", "x[8] = float(7 / int(x[3]));", "division of integers by 0");
    finds("x[8] = float(int(x[5]) % 3);", "x[8] = float(7 % int(x[3]));", "% of a negative operand, or by 0");
    finds("x[8] = sqrt(x[0]);", "x[8] = sqrt(x[2]);", "sqrt of a negative number");
    finds("x[8] = log(x[2]);", "x[8] = log(x[1]);", "log of 0 or less");
    finds("x[8] = inversesqrt(x[2]);", "x[8] = inversesqrt(x[1]);", "inversesqrt of 0 or less");
    finds("x[8] = asin(x[6]);", "x[8] = asin(x[1]);", "asin or acos beyond 1");
    finds("x[8] = atan(x[2], x[2]);", "x[8] = atan(x[2], x[1]);", "atan(0, 0)");
    finds("x[8] = normalize(vec3(x[2])).x;", "x[8] = normalize(vec3(x[1])).x;", "normalize of a vector of length 0");
    finds("x[8] = mod(1.0, x[2]);", "x[8] = mod(1.0, x[1]);", "mod by 0");
    finds("x[8] = float(bitfieldExtract(9u, 30, int(x[3])));", "x[8] = float(bitfieldExtract(9u, 30, 2));",
          "bit field beyond 32 bits");
    finds("x[8] = x[int(x[3]) * 100];", "x[8] = x[int(x[3])];", "access outside of a buffer");
    finds("float a[3] = float[3](1.0, 2.0, 3.0); x[9] = a[int(x[3])];",
          "float a[3] = float[3](1.0, 2.0, 3.0); x[9] = a[int(x[6])];", "index out of bounds");
}

TEST_CASE("text findings: a variable that was never set is found where something first depends on it") {
    const std::string rule = " use of a variable that was never set";
    CHECK(found_in("float v;\nif (x[0] > 1.0)\n    v = 2.0;\nfloat w = v + 1.0;\nx[1] = w;") == Lines{"6" + rule});
    CHECK(found_in("float v;\nif (x[0] < 1.0)\n    v = 2.0;\nx[1] = v + 1.0;").empty());
    CHECK(found_in("vec3 v;\nv.xy = vec2(1.0);\nx[1] = v.x + v.y;").empty());
    CHECK(found_in("vec3 v;\nv.xy = vec2(1.0);\nx[1] = length(v);") == Lines{"5" + rule});
    CHECK(found_in("float a[4];\nfor (int i = 0; i < 3; ++i) a[i] = 1.0;\nx[1] = a[int(x[0]) + 3];") ==
          Lines{"5" + rule});
    CHECK(found_in("float v;\nfloat unused = v * 2.0;\nx[1] = 1.0;").empty());
    CHECK(found_in("int n;\nif (n > 3)\n    x[0] = 1.0;") == Lines{"4" + rule});
    CHECK(found_in("bool is;\nif (x[0] > 1.0)\n    is = true;\nx[1] = 1.0;\nif (is)\n    x[0] = 1.0;") ==
          Lines{"7" + rule});
    CHECK(found_in("bool is;\nif (x[0] > 1.0) is = true;\nx[1] = 1.0;\n\nfor (int i = 0; is; ++i)\n    x[0] = 1.0;",
                   {}) == Lines{"7" + rule});
    CHECK(found_in("int n;\nx[1] = 1.0;\nswitch (n) {\ncase 1:\n    x[0] = 1.0;\n}") == Lines{"5" + rule});
    // The second operand of && and || counts where the first does not decide.
    const std::string both = "float v;\nbool is = x[0] > 1.0;\nif (is) v = 1.0;\nif (";
    CHECK(found_in(both + "is && v > 0.5)\n    x[1] = 1.0;").empty());
    CHECK(found_in(both + "!is || v > 0.5)\n    x[1] = 1.0;").empty());
    CHECK(found_in(both + "is || v > 0.5)\n    x[1] = 1.0;") == Lines{"6" + rule});
    CHECK(found_in(both + "!is && v > 0.5)\n    x[1] = 1.0;") == Lines{"6" + rule});
    CHECK(found_in("vec4 v;\nv.x = 2.0;\nvec4 w = v * x[0];\nx[1] = w.x;").empty());
    CHECK(found_in("vec4 v;\nv.x = 2.0;\nvec4 w = v * x[0];\nx[1] = w.y;") == Lines{"5" + rule});
    CHECK(found_in("float s;\nvec4 w = vec4(1.0) * s;\nx[1] = w.y;") == Lines{"4" + rule});
    const std::string with_out = R"(layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void some(float v, out float w) { if (v > 1.0) w = 3.0; }
void main() { float w; some(x[0], w);
x[1] = w; })";
    CHECK(found(with_out) == Lines{"5" + rule});
    CHECK(found(with_out, {1, 1, 1}, {2.0F}).empty());
    CHECK(found(R"(layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Out { float x[]; };
shared float sums[4];
void main() { if (gl_LocalInvocationID.x < 3u) sums[gl_LocalInvocationID.x] = 1.0;
barrier();
x[gl_LocalInvocationID.x] = sums[gl_LocalInvocationID.x]; })") ==
          Lines{"6 use of a shared variable that was never set"});
    const auto counted = [](const std::string& first) {
        return R"(layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Out { uint x[]; };
shared uint n;
void main() { if (gl_LocalInvocationIndex == 0u) { )" +
               first + R"(; }
barrier();
atomicAdd(n, 1u);
barrier();
x[gl_LocalInvocationIndex] = n; })";
    };
    CHECK(found(counted("atomicExchange(n, 0u)")).empty());
    CHECK(found(counted("x[0] = 1u")) == Lines{"6 use of a shared variable that was never set"});
}

TEST_CASE("text findings: a race on shared memory is found with both lines, and a barrier between is none") {
    const auto scan = [](const std::string& first, const std::string& second) {
        return R"(layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Out { float x[]; };
shared float sums[64];
void main() {
uint i = gl_LocalInvocationID.x;
sums[i] = x[i];
)" + first + R"(
float before = i > 0u ? sums[i - 1u] : 0.0;
)" + second + R"(
sums[i] += before;
barrier();
x[i] = sums[63u - i];
})";
    };
    const std::string rule = " race on shared memory";
    CHECK(found(scan("barrier();", "barrier();")).empty());
    CHECK(found(scan("", "barrier();")) == Lines{"8" + rule});
    CHECK(found(scan("barrier();", "")) == Lines{"10" + rule});
    CHECK(found(R"(layout(local_size_x = 64) in;
shared uint count;
layout(std430, binding = 0) buffer Out { uint x[]; };
void main() {
if (gl_LocalInvocationIndex == 0u) count = 0u;
barrier();
count += 1u;
barrier();
x[gl_LocalInvocationIndex] = count;
})") == Lines{"7" + rule});
    CHECK(found(R"(layout(local_size_x = 64) in;
shared uint count;
layout(std430, binding = 0) buffer Out { uint x[]; };
void main() {
if (gl_LocalInvocationIndex == 0u) count = 0u;
barrier();
atomicAdd(count, 1u);
barrier();
x[gl_LocalInvocationIndex] = count;
})")
              .empty());
}

TEST_CASE("text findings: a race on a buffer or image is found in a group and between groups") {
    const std::string rule = " race on a buffer";
    const auto shifts = [](const std::string& between) {
        return R"(layout(local_size_x = 16) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() {
uint i = gl_GlobalInvocationID.x;
x[i] = 1.0;
)" + between + R"(
x[64u + i] = x[i ^ 1u];
})";
    };
    CHECK(found(shifts("memoryBarrierBuffer(); barrier();")).empty());
    CHECK(found(shifts("barrier();")) == Lines{"7" + rule});
    CHECK(found(shifts("")) == Lines{"7" + rule});
    const std::string neighbour = R"(layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() {
uint i = gl_GlobalInvocationID.x;
x[i + 1u] = x[i] + 1.0;
})";
    CHECK(found(neighbour, {1, 1, 1}).empty());
    CHECK(found(neighbour, {2, 1, 1}) == Lines{"5" + rule});
    CHECK(found(R"(layout(local_size_x = 1) in;
layout(r32f) uniform image2D picture;
void main() {
ivec2 at = ivec2(gl_GlobalInvocationID.xy);
imageStore(picture, at, imageLoad(picture, at + ivec2(1, 0)));
})",
                {2, 1, 1}) == Lines{"5 race on an image"});
    CHECK(found(R"(layout(local_size_x = 1) in;
layout(r32f) uniform image2D picture;
void main() {
ivec2 at = ivec2(gl_GlobalInvocationID.xy);
imageStore(picture, at, imageLoad(picture, at) + 1.0);
})",
                {2, 1, 1})
              .empty());
}

TEST_CASE("text findings: a memory barrier orders what its own invocation touched before it") {
    const auto handed_on = [](const std::string& before) {
        return R"(layout(local_size_x = 64) in;
layout(std430, binding = 0) coherent buffer Out { float x[]; };
void main() { uint i = gl_LocalInvocationIndex;
if (i == 0u) x[64] = 2.0;
)" + before + R"(
barrier();
x[i] = x[64];
})";
    };
    CHECK(found(handed_on("if (i == 0u) memoryBarrierBuffer();")).empty());
    CHECK(found(handed_on("if (i != 0u) memoryBarrierBuffer();")) == Lines{"7 race on a buffer"});
    CHECK(found(handed_on("memoryBarrierImage();")) == Lines{"7 race on a buffer"});
}

TEST_CASE("text findings: an atomic operation after a memory barrier hands on what was written to another group") {
    const auto summed = [](const std::string& after_write, const std::string& last, const std::string& other) {
        return R"(layout(local_size_x = 8) in;
layout(std430, binding = 0) coherent buffer Parts { float parts[]; };
layout(std430, binding = 1) coherent buffer Count { uint count, other; float sum; };
shared bool is_last;
void main() { uint i = gl_LocalInvocationIndex;
if (i == 0u) {
parts[gl_WorkGroupID.x] = 1.0;
)" + after_write +
               R"(
is_last = atomicAdd(count, 1u) == )" +
               last + R"(;
}
barrier();
if (is_last && i == )" +
               other + R"() for (uint k = 0u; k < 4u; ++k) sum += parts[k];
})";
    };
    const std::string fence = "memoryBarrierBuffer();";
    CHECK(found(summed(fence, "3u", "0u"), {4, 1, 1}).empty());
    CHECK(found(summed(fence, "3u", "5u"), {4, 1, 1}).empty()); // by way of the barrier
    CHECK(found(summed("", "3u", "0u"), {4, 1, 1}) == Lines{"12 race on a buffer"});
    CHECK(found(summed("atomicAdd(other, 1u); " + fence, "3u", "0u"), {4, 1, 1}).empty());
    CHECK(found(summed(fence + " parts[gl_WorkGroupID.x] = 2.0;", "3u", "0u"), {4, 1, 1}) ==
          Lines{"12 race on a buffer"});
}

TEST_CASE("text findings: an index out of bounds is no race, and a race hides no variable that was never set") {
    CHECK(found(R"(layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Out { float x[]; };
shared float t[8];
void main() { uint i = gl_LocalInvocationIndex;
t[i + 4u] = 2.0;
x[i + 1000u] = 2.0;
})") == Lines{"5 index out of bounds", "6 access outside of a buffer"});
    CHECK(found(R"(layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() { float v;
x[0] = v + float(gl_LocalInvocationIndex);
})") == Lines{"4 use of a variable that was never set", "4 race on a buffer"});
}

TEST_CASE("text findings: a race names both invocations and lines, and counts how often it was seen") {
    TextKernel kernel(R"(layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() {
x[0] = float(gl_LocalInvocationIndex);
})");
    kernel.blocks["Out"].resize(1);
    kernel.is_watched = true;
    kernel.run();
    REQUIRE(kernel.findings.all().size() == 1);
    const text::Finding& race = kernel.findings.all().front();
    CHECK(race.place == text::Place{5, 1});
    CHECK(race.other == text::Place{5, 0});
    CHECK(race.times == 3);
    CHECK(race.what ==
          "invocation 1 writes what invocation 0 touched without a barrier and a memory barrier between: Out");
}

TEST_CASE("text findings: a barrier that not all of a group come to is found, with where the others are") {
    const std::string rule = " barrier that not all invocations of a group come to";
    CHECK(found(R"(layout(local_size_x = 40) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() {
if (gl_LocalInvocationID.x < 24u)
barrier();
})") == Lines{"5" + rule});
    CHECK(found(R"(layout(local_size_x = 40) in;
layout(std430, binding = 0) buffer Out { float x[]; };
void main() {
if (gl_LocalInvocationID.x < 24u) {
barrier();
x[gl_LocalInvocationID.x] = 1.0;
} else
barrier();
})") == Lines{"5" + rule});
}

TEST_CASE("text findings: a loop that does not end is a finding, and ends the dispatch") {
    CHECK(found_in("while (x[0] == 0.0)\n    x[1] += 1.0;\nx[2] = pow(-1.0, 2.0);") ==
          Lines{"4 loop that does not end"});
}

} // namespace lockstep::test::findings_test
