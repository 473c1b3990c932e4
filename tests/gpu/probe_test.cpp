#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "gpu/check.hpp"
#include "gpu/probe.hpp"
#include "gpu/probe/judge.hpp"
#include "gpu/probe/points_alike.hpp"
#include "gpu/probe/snap.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/gpu/probe_rows.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::probe_test {

using probing::judge;

using test::open_context;

namespace {

bool is_llvmpipe(const ContextInfo& info) { return info.renderer.starts_with("llvmpipe"); }

/// "4.5 (Core Profile) Mesa 25.0.7": 25.
int mesa_release(const ContextInfo& info) {
    const std::size_t at = info.version.find("Mesa ");
    REQUIRE(at != std::string::npos);
    return std::stoi(info.version.substr(at + 5));
}

bool is_known(const ProbeRow& row, std::string_view earliest, int release, bool fused) {
    for (const test::LaterRow& later : test::later_rows)
        if (later.name == row.name && (fused || !later.is_fused))
            return (release < later.first_with && row.finding == earliest) ||
                   (release > later.last_without && row.finding == later.finding);
    return row.finding == earliest;
}

/// Every row there is has to be as llvmpipe's is known to be.
void check_rows(const ProbeResult& result, bool fused) {
    const int release = mesa_release(result.context);
    for (const auto& [name, finding] : test::llvmpipe_rows) {
        const ProbeRow& row = result.row(name);
        INFO(name << ": " << row.finding << ", " << row.matched << " of " << row.total);
        CHECK(is_known(row, finding, release, fused));
    }
    for (const test::ProcessorRow& expected : test::processor_rows)
        CHECK(result.row(expected.name).finding == (fused ? expected.fused : expected.separate));
    CHECK(result.rows.size() == std::size(test::llvmpipe_rows) + std::size(test::processor_rows));
}

bool uses_own_reciprocal(const std::string& candidate) {
    return candidate.find("*r") != std::string::npos || candidate.find(", r,") != std::string::npos;
}

bool has_fused(const ProbeResult& result) {
    return result.row(test::processor_rows[0].name).finding == test::processor_rows[0].fused;
}

struct Run {
    int status = 0;
    std::string told; ///< what it printed last
};

/// The program as a child, since a driver looks at its environment once a process.
Run run(const std::string& environment, const std::string& arguments) {
    const test::TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string();
    const int status =
        std::system(fmt::format("env {} '{}' {} >'{}' 2>&1", environment, LOCKSTEP_PROGRAM, arguments, out).c_str());
    Run result{WEXITSTATUS(status), {}};
    std::ifstream lines(out);
    for (std::string line; std::getline(lines, line);)
        result.told = line;
    return result;
}

struct Child {
    ProbeResult result;
    std::string profile;
};

Child probe_in_child(const std::string& environment) {
    const test::TemporaryFolder folder;
    const std::string file = (folder.path() / "probe.json").string();
    const Run ended = run(environment, fmt::format("probe --gl {} --json '{}'", test::software_gl(), file));
    INFO(environment << ": " << ended.told);
    REQUIRE(ended.status == 0);
    const auto json = nlohmann::json::parse(std::ifstream(file));
    CHECK(ended.told == "profile " + json.at("profile").get<std::string>());
    return {json.get<ProbeResult>(), json.at("profile")};
}

} // namespace

TEST_CASE("probe: llvmpipe measures as known, on every context") {
    for (const char* name : {"osmesa", "egl"}) {
        const auto context = open_context(name);
        if (!context || !is_llvmpipe(context->describe()))
            continue;
        INFO(name);
        const ProbeResult result = probe(*context);
        check_rows(result, has_fused(result));
        CHECK(result.context.renderer == context->describe().renderer);
        CHECK(result.row("dot(vec3)").total == ProbeOptions{}.inputs);
    }
}

TEST_CASE("probe: tells sequences apart") {
    const auto context = open_context(test::software_gl());
    if (!context)
        return;
    const ProbeResult result = probe(*context);
    // Only one candidate may explain everything, or the finding would be a matter of their order. Not asked of those
    // made of r, the driver's own reciprocal, which is the rounded one where the driver divides correctly.
    for (const char* name : {"dot(vec3)",
                             "mat4*vec4",
                             "a*b+c",
                             "x*a+x*b",
                             "cross",
                             "fma",
                             "unorm8 to float",
                             "float to half",
                             "float to unorm8",
                             "points: snap",
                             "points: sub-pixel bits",
                             "triangles: sub-pixel bits",
                             "triangles: left side",
                             "points: viewport",
                             "triangles: viewport",
                             "points: depth",
                             "equal depth, LESS",
                             "image: store to half",
                             "image: blend rgba32f",
                             "image: blend rgba16f",
                             "image: linear filter, weights",
                             "image: linear filter",
                             "image: linear filter, border of 0",
                             "image: linear filter of a plane"}) {
        const ProbeRow& row = result.row(name);
        INFO(name);
        if (row.finding == none_known)
            continue;
        for (const ProbeCandidate& other : row.candidates)
            if (other.name != row.finding && !uses_own_reciprocal(other.name)) {
                INFO(other.name);
                CHECK(other.matched < row.total);
            }
    }
}

TEST_CASE("probe: llvmpipe's rows and profile are the same for every vector width and processor") {
    const auto context = open_context(test::software_gl());
    if (!context || !is_llvmpipe(context->describe()))
        return;
    const Child native = probe_in_child("LOCKSTEP=1");
    check_rows(native.result, has_fused(native.result));
    const bool dots_alike = native.result.row("dot(vec3), precise").finding == native.result.row("dot(vec3)").finding;
    CHECK_THAT(native.profile, Catch::StartsWith(dots_alike ? "llvmpipe: " : "generic: "));
    for (const char* environment : {"LP_NATIVE_VECTOR_WIDTH=128", "LP_NATIVE_VECTOR_WIDTH=512"}) {
        INFO(environment);
        constexpr int segmentation_fault = 139;
        if (mesa_release(native.result.context) >= 26 &&
            run(environment, "probe --gl " + test::software_gl()).status == segmentation_fault) {
            WARN(environment << ": this Mesa crashes with it");
            continue;
        }
        const Child child = probe_in_child(environment);
        check_rows(child.result, has_fused(native.result));
        CHECK(child.profile == native.profile);
    }
    const Child old = probe_in_child("GALLIUM_OVERRIDE_CPU_CAPS=sse4.1");
    check_rows(old.result, false);
    CHECK(old.profile == native.profile);
    if (has_fused(native.result))
        for (const char* name : {"sin", "exp2", "pow(x,2.2)"})
            CHECK(old.result.row(name).matched != native.result.row(name).matched);
}

TEST_CASE("probe: a driver that rounds otherwise is told from llvmpipe") {
    const auto context = open_context(test::software_gl());
    if (!context || !is_llvmpipe(context->describe()))
        return;
    const Child child = probe_in_child("GALLIUM_DRIVER=softpipe");
    CHECK(child.result.row("dot(vec3)").finding == "(x+y)+z");
    CHECK_THAT(child.profile, Catch::StartsWith("generic: ") && Catch::Contains("not followed"));
}

TEST_CASE("probe: a shader language without precise is an error") {
    const auto context = open_context(test::software_gl());
    if (!context || !is_llvmpipe(context->describe()))
        return;
    const Run ended = run("MESA_GL_VERSION_OVERRIDE=3.3 MESA_EXTENSION_OVERRIDE=-GL_ARB_gpu_shader5",
                          "probe --gl " + test::software_gl());
    CHECK(ended.status == 2);
    CHECK(ended.told == "lockstep: probe: the context's GLSL has no `precise`; GL 4.0 or GL_ARB_gpu_shader5 has");
}

TEST_CASE("probe: what the command is given is checked") {
    CHECK(run("", "probe --inputs 1").status == 2);
    CHECK(run("", "probe --gl nowhere").status == 2);
}

TEST_CASE("probe: leaves GL as it found it") {
    const auto context = open_context();
    if (!context)
        return;
    probe(*context, {64});
    CHECK(gl::GetError() == GL_NO_ERROR);
    const auto integer = [](GLenum name) {
        GLint value = -1;
        gl::GetIntegerv(name, &value);
        return value;
    };
    CHECK(integer(GL_DRAW_FRAMEBUFFER_BINDING) == 0);
    CHECK(integer(GL_VERTEX_ARRAY_BINDING) == 0);
    CHECK(integer(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING) == 0);
    CHECK(integer(GL_ACTIVE_TEXTURE) == GL_TEXTURE0);
    CHECK(integer(GL_DEPTH_FUNC) == GL_LESS);
    CHECK(gl::IsEnabled(GL_DEPTH_TEST) == GL_FALSE);
    CHECK(gl::IsEnabled(GL_RASTERIZER_DISCARD) == GL_FALSE);
}

TEST_CASE("probe: the first candidate that explains every input is the finding") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ProbeRow row = judge<float>(
        "r", {1.0F, nan, -0.0F}, {{"wrong", {1.0F, nan, 0.0F}}, {"a", {1.0F, nan, -0.0F}}, {"b", {1.0F, nan, -0.0F}}});
    CHECK(row.finding == "a");
    CHECK(row.matched == 3);
    CHECK(row.total == 3);
    CHECK(row.max_ulp == 0);
    CHECK(candidate(row, "wrong").matched == 2);
}

TEST_CASE("probe: where nothing explains every input, the closest candidate is told") {
    const ProbeRow row =
        judge<float>("r", {1.0F, 2.0F}, {{"far", {0.0F, 0.0F}}, {"near", {1.0F, 0x1.000006p1F}}, {"nan", {NAN, NAN}}});
    CHECK(row.finding == none_known);
    CHECK(row.matched == 1);
    CHECK(row.max_ulp == 3);
    CHECK(candidate(row, "nan").max_ulp == INT64_MAX);
}

TEST_CASE("probe: nothing to judge by is an error") {
    CHECK_THROWS_WITH(judge<float>("r", {}, {{"a", {}}}), "probe: row 'r' has nothing to be judged by");
    CHECK_THROWS_WITH(judge<int>("r", {1}, {{"a", {}}}), "probe: row 'r' has nothing to be judged by");
    CHECK_THROWS_WITH(judge<int>("r", {1}, {}), "probe: row 'r' has nothing to be judged by");
}

TEST_CASE("probe: a row or candidate that is not there is named") {
    CHECK_THROWS_WITH(ProbeResult{}.row("dot"), "probe: there is no row 'dot'");
    ProbeRow row;
    row.name = "dot";
    CHECK_THROWS_WITH(candidate(row, "fused"), "probe: row 'dot' has no candidate 'fused'");
}

TEST_CASE("probe: a result survives JSON") {
    ProbeResult result;
    result.context.renderer = "some";
    result.seconds = 0.5;
    result.rows.push_back(judge<int>("r", {1, 2}, {{"a", {1, 3}}, {"b", {1, 2}}}));
    const auto again = nlohmann::json::parse(nlohmann::json(result).dump()).get<ProbeResult>();
    CHECK(again.context.renderer == "some");
    CHECK(again.seconds == 0.5);
    REQUIRE(again.rows.size() == 1);
    CHECK(again.row("r").finding == "b");
    CHECK(candidate(again.row("r"), "a").matched == 1);
}

TEST_CASE("probe: the pixel of a point on its sub-pixel grid") {
    const probing::Snap snap{8, probing::snap_roundings()[1]};
    CHECK(probing::point_pixel(5.0, snap, true) == 4);
    CHECK(probing::point_pixel(5.0, snap, false) == 5);
    CHECK(probing::point_pixel(5.0 + 1.0 / 1024, snap, true) == 4);
    CHECK(probing::point_pixel(5.0 + 3.0 / 1024, snap, true) == 5);
    CHECK(probing::point_pixel(0.0, snap, true) == -1);
}

TEST_CASE("points go to the same pixels without a geometry stage where the rows say so") {
    const auto context = open_context();
    const ProbeResult result = probe(*context, {std::size_t{1} << 8U});
    const auto alike = [&](const std::string& row) {
        const ProbeRow &with = result.row(row), &without = result.row(row + ", no geometry stage");
        return with.finding == without.finding && with.matched == without.matched;
    };
    CHECK(points_alike_without_geometry() == (alike("points: viewport") && alike("points: depth")));
}

} // namespace lockstep::test::probe_test
