#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/function.hpp>

#include "tests/temporary_folder.hpp"

namespace lockstep::test::function_test {

using Catch::Contains;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using lockstep::test::TemporaryFolder;

namespace {

const Gl& gl() {
    static const Gl one;
    return one;
}

namespace site {
constexpr Site into{"into the wall"}, kept{"kept"}, weight{"weight"}, away{"away"};
} // namespace site

const std::string bounce_text = "// What a wall leaves of a velocity.\n"
                                "uniform float u_Kept;\n"
                                "vec3 bounce(vec3 velocity, const in vec3 n) {\n"
                                "    precise float into = (velocity.x * n.x + velocity.y * n.y) + velocity.z * n.z;\n"
                                "    precise vec3 left = velocity - n * (into * (1.0 + u_Kept));\n"
                                "    return left;\n"
                                "}\n";

const auto bounce = [](auto& r, const auto& velocity, const auto& n) {
    const auto into = r.note(site::into, (velocity.x * n.x + velocity.y * n.y) + velocity.z * n.z);
    return velocity - n * (into * (1.0F + r.uniform(site::kept, 0.5F)));
};

/// Vectors in [-1, 1), the same everywhere.
vec3 scattered(std::uint32_t i) {
    const auto at = [&](std::uint32_t k) {
        std::uint32_t h = i * 2654435761U + k * 2246822519U;
        h = (h ^ (h >> 15U)) * 2246822519U;
        return static_cast<float>(h >> 8U) * 0x1p-23F - 1.0F;
    };
    return {at(1), at(2), at(3)};
}

FunctionTable<vec3, vec3> walls(std::uint32_t rows = 500) {
    FunctionTable<vec3, vec3> table;
    for (std::uint32_t i = 0; i < rows; ++i)
        table.emplace_back(scattered(2 * i), scattered(2 * i + 1));
    return table;
}

MatchResult match_bounce(const std::string& text, const std::string& name = "bounce") {
    const TemporaryFolder folder;
    return match_function(gl(), {folder.write("wall.glsl", text).string(), name, {{"u_Kept", 0.5F}}}, walls(), bounce);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

std::string error_of(const std::string& text, const std::string& name = "bounce") {
    try {
        return "no error: " + match_bounce(text, name).text();
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("function: one that computes what its twin says agrees on every row") {
    if (!gl())
        return skip(gl().missing());
    const MatchResult result = match_bounce(bounce_text);
    INFO(result.text());
    CHECK(result.passed());
    CHECK(result.report().verdict == Verdict::agree);
    CHECK_THAT(result.text(), Contains("500 rows"));
}

TEST_CASE("function: a planted bug is divergent in its row, with the operation behind it") {
    if (!gl())
        return skip(gl().missing());
    const MatchResult sign = match_bounce(replaced(bounce_text, "1.0 + u_Kept", "1.0 - u_Kept"));
    CHECK(!sign.passed());
    CHECK(sign.report().verdict == Verdict::divergent);
    const MatchResult component = match_bounce(replaced(bounce_text, "velocity.y * n.y", "velocity.y * n.z"));
    CHECK(component.report().verdict == Verdict::divergent);
    CHECK_THAT(component.text(), Contains("row ") && Contains("result"));
    CHECK(match_bounce(replaced(bounce_text, "u_Kept)", "u_Kept * 1.000001)")).report().verdict == Verdict::divergent);
}

TEST_CASE("function: numbers, integers and vectors of each size; a whole stage's function, without its main") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const std::string stage = folder
                                  .write("texels.vert", "#version 330 core\n"
                                                        "in vec3 a_Position;\n"
                                                        "uniform mat4 u_ProjView;\n"
                                                        "int texel_of(vec2 at, int width) {\n"
                                                        "    return int(at.y) * width + int(at.x);\n"
                                                        "}\n"
                                                        "vec4 mixed(vec4 a, vec2 b, float t) {\n"
                                                        "    return vec4(a.x * t, a.y + b.x, b.y, a.w);\n"
                                                        "}\n"
                                                        "float first(vec4 V, vec4 v) { return V.x; }\n"
                                                        "void main() { gl_Position = u_ProjView * vec4(a_Position, "
                                                        "float(texel_of(a_Position.xy, 3))); }\n")
                                  .string();
    FunctionTable<vec2, int> places;
    FunctionTable<vec4, vec2, float> mixtures;
    FunctionTable<vec4, vec4> pairs;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const vec3 v = scattered(i);
        places.emplace_back(vec2(50.0F + 40.0F * v.x, 50.0F + 40.0F * v.y), static_cast<int>(i) + 1);
        mixtures.emplace_back(vec4(v, v.x * 3.0F), vec2(v.y, v.z), v.z);
        pairs.emplace_back(vec4(v, 1.0F), vec4(v.y));
    }
    const MatchResult texel = match_function(gl(), {stage, "texel_of"}, places, [](auto& r, const auto& at, int width) {
        return r.to_int(site::weight, at.y) * width + r.to_int(site::away, at.x);
    });
    INFO(texel.text());
    CHECK(texel.report().verdict == Verdict::agree);
    const MatchResult mixture =
        match_function(gl(), {stage, "mixed"}, mixtures, [](auto&, const auto& a, const auto& b, const auto& t) {
            return std::remove_cvref_t<decltype(a)>{a.x * t, a.y + b.x, b.y, a.w};
        });
    INFO(mixture.text());
    CHECK(mixture.passed());
    const MatchResult one =
        match_function(gl(), {stage, "first"}, pairs, [](auto&, const auto& a, const auto&) { return a.x; });
    CHECK(one.report().verdict == Verdict::agree);
}

TEST_CASE("function: integers without sign, vectors of integers and truths, given and returned") {
    if (!gl())
        return lockstep::skip(gl().missing());
    const TemporaryFolder folder;
    const std::string file = folder
                                 .write("words.glsl", "uint hash(uint x, bool twice) {\n"
                                                      "    x = (x ^ (x >> 16u)) * 2246822519u;\n"
                                                      "    return twice ? x * 2u : x;\n"
                                                      "}\n"
                                                      "uvec3 spread(ivec2 c, uvec3 by) {\n"
                                                      "    return uvec3(uint(c.x), uint(c.y), 7u) * by;\n"
                                                      "}\n"
                                                      "bool inside(ivec3 c) { return c.x >= c.y && c.x < c.z; }\n")
                                 .string();
    FunctionTable<std::uint32_t, bool> words;
    FunctionTable<glm::ivec2, glm::uvec3> cells;
    FunctionTable<glm::ivec3> ranges;
    for (std::uint32_t i = 0; i < 200; ++i) {
        words.emplace_back(i * 2654435761U, i % 3 == 0);
        cells.emplace_back(glm::ivec2(static_cast<int>(i) - 100, 5), glm::uvec3(i, 3000000000U, 1U));
        ranges.emplace_back(glm::ivec3(static_cast<int>(i) - 100, -20, 30));
    }
    const auto passes = [&](const MatchResult& result) {
        INFO(result.text());
        CHECK(result.report().verdict == Verdict::agree);
    };
    passes(match_function(gl(), {file, "hash"}, words, [](auto& /*r*/, std::uint32_t x, bool twice) {
        x = (x ^ (x >> 16U)) * 2246822519U;
        return twice ? x * 2U : x;
    }));
    passes(match_function(gl(), {file, "spread"}, cells, [](auto& /*r*/, const glm::ivec2& c, const glm::uvec3& by) {
        return glm::uvec3(static_cast<std::uint32_t>(c.x), static_cast<std::uint32_t>(c.y), 7U) * by;
    }));
    passes(match_function(gl(), {file, "inside"}, ranges,
                          [](auto& /*r*/, const glm::ivec3& c) { return c.x >= c.y && c.x < c.z; }));
    const MatchResult wrong = match_function(gl(), {file, "inside"}, ranges,
                                             [](auto& /*r*/, const glm::ivec3& c) { return c.x >= c.y && c.x <= c.z; });
    CHECK(wrong.report().verdict == Verdict::divergent);
    CHECK(wrong.report().total.differing(0) == 1);
}

TEST_CASE("function: what GLSL leaves open is legal, and only that") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const auto run = [&](const std::string& formula) {
        const std::string file =
            folder.write("unit.glsl", "vec3 unit(vec3 v) { precise vec3 n = " + formula + "; return n; }\n").string();
        FunctionTable<vec3> table;
        for (std::uint32_t i = 0; i < 300; ++i)
            table.emplace_back(scattered(i));
        return match_function(gl(), {file, "unit"}, table,
                              [](auto& r, const auto& v) { return r.normalize(site::away, v); })
            .report()
            .verdict;
    };
    const Verdict right = run("normalize(v)");
    CHECK((right == Verdict::agree || right == Verdict::legal));
    CHECK(run("v") == Verdict::divergent);
    CHECK(run("normalize(v) * 1.00001") == Verdict::divergent);
}

TEST_CASE("function: what cannot be run says where and what would be right") {
    if (!gl())
        return skip(gl().missing());
    CHECK_THAT(error_of(bounce_text, "bounse"),
               Contains("wall.glsl: defines no function bounse; it has bounce; did you mean bounce?"));
    CHECK_THAT(error_of(bounce_text + bounce_text),
               Contains("wall.glsl:10: bounce is defined more than once; expected one of 'bounce("));
    CHECK_THAT(error_of(replaced(bounce_text, "vec3 velocity", "vec4 velocity")),
               Contains("wall.glsl:3: vec3 bounce(vec4, vec3): column 1 of the table is vec3, argument 1 is vec4"));
    CHECK_THAT(error_of(replaced(bounce_text, "const in vec3 n", "const in vec3 n, float t")),
               Contains("the table has 2 columns for 3 arguments"));
    CHECK_THAT(error_of(replaced(bounce_text, "vec3 bounce", "mat3 bounce")),
               Contains("its result must be float, int, uint, bool, or a vector of float, int or uint"));
    CHECK_THAT(error_of(replaced(bounce_text, "const in vec3 n", "out vec3 n")),
               Contains("column 2 of the table is vec3, argument 2 is out"));
    CHECK_THAT(error_of(replaced(bounce_text, "u_Kept)", "u_Keptt)")), Contains("wall.glsl:5"));
    CHECK_THAT(error_of(replaced(bounce_text, "uniform float u_Kept;", "uniform float u_Kept, u_More;") +
                        "float more() { return u_More; }\n"),
               Contains("no error"));
    CHECK_THAT(
        error_of(replaced(replaced(bounce_text, "u_Kept;", "u_Kept, u_More;"), "1.0 + u_Kept", "u_More + u_Kept")),
        Contains("nothing is given for uniform u_More"));
}

TEST_CASE("function: a value for a uniform that no file declares is an error that names those there are") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const std::string file = folder.write("wall.glsl", bounce_text).string();
    CHECK_THROWS_WITH(match_function(gl(), {file, "bounce", {{"u_Kept", 0.5F}, {"u_Kep", 0.5F}}}, walls(1), bounce),
                      Contains("wall.glsl: declares no uniform u_Kep; it has u_Kept; did you mean u_Kept?"));
    CHECK_THROWS_WITH(match_function(gl(), {file, "bounce"}, walls(1), bounce),
                      Contains("nothing is given for uniform u_Kept") && Contains("the uniforms of GlslFunction") &&
                          !Contains("bindings.json"));
}

// What no system and no function has is no option of theirs.
template <class Options> constexpr bool has_render = requires(Options o) { o.render; };
template <class Options> constexpr bool has_hits = requires(Options o) { o.require_hits; };
template <class Options> constexpr bool has_frames = requires(Options o) { o.frames; };
static_assert(has_render<MatchOptions> && has_hits<MatchOptions>);
static_assert(!has_render<SystemMatchOptions> && !has_hits<SystemMatchOptions> && has_frames<SystemMatchOptions>);
static_assert(!has_render<FunctionMatchOptions> && !has_hits<FunctionMatchOptions> &&
              !has_frames<FunctionMatchOptions>);
static_assert(std::is_invocable_v<decltype(match_system), SystemSide&, const System&, const SystemMatchOptions&> &&
              !std::is_invocable_v<decltype(match_system), SystemSide&, const System&, const MatchOptions&>);

} // namespace lockstep::test::function_test
