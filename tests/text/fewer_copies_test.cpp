#include <catch2/catch.hpp>

#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/text/text_kernel.hpp"

namespace lockstep::test::fewer_copies_test {

namespace {

/// Statements that move values to and fro, of a generator's choice.
class Statements {
  public:
    explicit Statements(std::uint32_t seed) : random_(seed) {}

    std::string some(int depth) {
        std::string all;
        for (std::uint32_t k = 0; k < 6; ++k)
            all += one(depth) + "\n";
        return all;
    }

  private:
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_()) % n; }
    std::string number() { return std::vector<std::string>{"a", "b", "c", "kept"}[below(4)]; }
    std::string vector() { return std::vector<std::string>{"u", "v", "w"}[below(3)]; }
    std::string swizzle(std::uint32_t n) {
        std::string parts = "xyz";
        std::shuffle(parts.begin(), parts.end(), random_);
        return vector() + "." + parts.substr(0, n);
    }
    std::string one(int depth) {
        switch (below(depth > 0 ? 15 : 11)) {
        case 0:
            return fmt::format("{} = {};", number(), number());
        case 1:
            return fmt::format("{} = {} + {} * 0.5;", number(), number(), number());
        case 2:
            return fmt::format("{} = {};", vector(), swizzle(3));
        case 3:
            return fmt::format("{} = {};", swizzle(2), swizzle(2));
        case 4:
            return fmt::format("{} = vec3({}, {}, {});", vector(), number(), swizzle(1), number());
        case 5:
            return fmt::format("{} = {} * {} - {};", vector(), vector(), number(), swizzle(3));
        case 6:
            return fmt::format("swap({}, {});", "a", below(2) == 0 ? "b" : "c");
        case 7:
            return fmt::format("m[(i + {}u) % 4u] = {};", below(4), number());
        case 8:
            return fmt::format("{} = m[i % {}u];", number(), 1 + below(4));
        case 9:
            return fmt::format("{} = turned({}, {});", vector(), vector(), number());
        case 10:
            return fmt::format("{} = {} > {} && {} < 3.0 ? {} : min({}, {});", number(), number(), number(), number(),
                               swizzle(1), number(), number());
        case 11:
            return fmt::format("if ({} > {}) {{\n{}}}", number(), number(), some(depth - 1));
        case 12:
            return fmt::format("if (i % 3u == {}u) {{\n{}}} else {{\n{}}}", below(3), some(depth - 1), some(depth - 1));
        case 13:
            return fmt::format("for (uint k{0} = 0u; k{0} < i % 4u; ++k{0}) {{\n{1}}}", depth, some(depth - 1));
        default:
            return fmt::format("switch (i % 4u) {{ case 1u: {} break; case 2u: {} default: {} }}", one(0), one(0),
                               one(0));
        }
    }

    std::mt19937 random_;
};

} // namespace

TEST_CASE("text: in fewer steps a kernel leaves the words that all of its steps leave") {
    std::size_t all_steps = 0, fewer_steps = 0;
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const std::string text = fmt::format(R"(layout(local_size_x = 64) in;
            layout(std430, binding = 0) buffer Out {{ float x[]; }};
            void swap(inout float s, inout float t) {{ float old = s; s = t; t = old; }}
            vec3 turned(vec3 p, float far) {{ if (far > 2.0) return p.yzx; p.x += far; return p; }}
            void main() {{
                uint i = gl_GlobalInvocationID.x;
                float a = float(i), b = 1.0, c, kept = 0.25, m[4];
                vec3 u = vec3(a, 2.0, 3.0), v = vec3(b), w;
                {}
                float all[] = float[](a, b, c, kept, m[0], m[1], m[2], m[3], u.x, u.y, u.z, v.x, v.y, v.z, w.x, w.y, w.z);
                for (int k = 0; k < 17; ++k)
                    x[17u * i + uint(k)] = all[k];
            }})",
                                             Statements(seed).some(2));
        INFO(text);
        TextKernel kernel(text);
        REQUIRE(kernel.program.fewer != nullptr);
        all_steps += kernel.program.steps.size();
        fewer_steps += kernel.program.fewer->steps.size();
        std::vector<std::vector<std::uint32_t>> words;
        for (const bool in_all : {false, true}) {
            if (in_all)
                kernel.program.fewer = nullptr;
            kernel.blocks["Out"].assign(std::size_t{17} * 64, 0U);
            kernel.run();
            words.push_back(kernel.blocks["Out"]);
        }
        CHECK(words[0] == words[1]);
        CHECK(kernel.findings.all().empty());
    }
    CHECK(fewer_steps < all_steps * 3 / 4);
}

} // namespace lockstep::test::fewer_copies_test
