#include <catch2/catch.hpp>

#include <fstream>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "reference/known_operations.hpp"
#include "tests/gpu/probe_rows.hpp"

namespace lockstep::test::profiles_test {

namespace {

constexpr std::uint64_t total = 100;

ProbeRow found(std::string name, std::string finding) {
    ProbeRow row;
    row.name = std::move(name);
    row.finding = finding;
    row.matched = row.total = total;
    row.candidates.push_back({std::move(finding), total, 0});
    return row;
}

/// The spec's llvmpipe column, last section, as the probe words it; only what a profile is made from.
ProbeResult llvmpipe() {
    ProbeResult result;
    const std::pair<const char*, const char*> rows[] = {
        {"dot(vec3)", "x+(y+z)"},
        {"dot(vec3), precise", "x+(y+z)"},
        {"mat4*vec4, precise", "((x+y)+z)+w"},
        {"mat4*vec4 written out, precise", "((x+y)+z)+w"},
        {"x*x+y*y+z*z, precise", "(x+y)+z"},
        {"a*b+c, precise", "each rounded"},
        {"x*a+x*b, precise", "each rounded"},
        {"cross, precise", "each rounded"},
        {"fragment a*b+c, precise", "each rounded"},
        {"a/b", "rounded"},
        {"a/b, precise", "rounded"},
        {"fragment a/b", "rounded"},
        {"1/b", "rounded"},
        {"1/b, precise", "rounded"},
        {"fragment 1/b", "rounded"},
        {"sqrt", "rounded"},
        {"sqrt, precise", "rounded"},
        {"fragment sqrt", "rounded"},
        {"inversesqrt", "1/sqrt(x), each rounded"},
        {"inversesqrt, precise", "1/sqrt(x), each rounded"},
        {"fragment inversesqrt", "1/sqrt(x), each rounded"},
        {"length", "sqrt(dot), rounded"},
        {"length, precise", "sqrt(dot), rounded"},
        {"normalize", "v*(1/sqrt(dot)), rounded"},
        {"normalize, precise", "v*(1/sqrt(dot)), rounded"},
        {"subnormal operand of *", "flushed"},
        {"subnormal result of *", "flushed"},
        {"subnormal operand of +", "flushed"},
        {"subnormal result of +", "flushed"},
        {"subnormal > 0", "flushed"},
        {"subnormal passed on", "kept"},
        {"compute: subnormal operand of *", "kept"},
        {"compute: subnormal result of *", "kept"},
        {"transform feedback order", "as drawn"},
        {"points: edge in x", "lower pixel"},
        {"points: edge in y", "lower pixel"},
        {"points: sub-pixel bits", "8"},
        {"triangles: sub-pixel bits", "8"},
        {"points: snap", "half away from zero"},
        {"triangles: snap", "half to even"},
        {"triangles: left side", "in"},
        {"triangles: right side", "out"},
        {"triangles: lower side", "in"},
        {"triangles: upper side", "out"},
        {"points: viewport", "(clip*(1/w))*scale + offset"},
        {"triangles: viewport", "(clip*(1/w))*scale + offset"},
        {"points: depth", "(clip*(1/w))*0.5 + 0.5"},
        {"equal depth, LESS", "first stays"},
    };
    for (const auto& [name, finding] : rows)
        result.rows.push_back(found(name, finding));
    return result;
}

ProbeRow& row(ProbeResult& result, const std::string& name) {
    return *std::find_if(result.rows.begin(), result.rows.end(), [&](const ProbeRow& r) { return r.name == name; });
}

void find(ProbeResult& result, const std::string& name, const std::string& finding) {
    row(result, name) = found(name, finding);
}

/// The row's operation is nothing known, and that far off from what the reference computes.
void be_off(ProbeResult& result, const std::string& name, std::int64_t ulp) {
    ProbeRow& r = row(result, name);
    r.candidates.front().matched = total / 2;
    r.candidates.front().max_ulp = ulp;
    r.finding = none_known;
    r.matched = total / 2;
    r.max_ulp = ulp;
}

/// What was measured on an H200.
ProbeResult nvidia() {
    std::ifstream file("data/results/h200/probe.json");
    return nlohmann::json::parse(file).get<ProbeResult>();
}

} // namespace

TEST_CASE("profiles: what measures as llvmpipe is llvmpipe, whatever it is called") {
    ProbeResult result = llvmpipe();
    result.context.renderer = "NVIDIA H200";
    const Profile profile = profile_from(result);
    CHECK(profile.name == "llvmpipe");
    CHECK(profile.not_followed.empty());
    CHECK(describe(profile) == "llvmpipe: dot x + (y + z), division and roots rounded, subnormals flushed, "
                               "8 sub-pixel bits, points on an edge to the lower pixel");
}

TEST_CASE("profiles: what measures as the NVIDIA column is nvidia, with the errors measured") {
    ProbeResult result = nvidia();
    result.context.renderer = "llvmpipe";
    const Profile profile = profile_from(result);
    CHECK(profile.name == "nvidia");
    CHECK(profile.dot == DotOrder::fused_chain);
    CHECK(profile.errors.divide == 2);
    CHECK(profile.errors.reciprocal == 1);
    CHECK(profile.errors.sqrt == 3);
    CHECK(profile.errors.inverse_sqrt == 2);
    CHECK(profile.errors.length == 2);
    CHECK(profile.errors.normalize == 3);
    CHECK(built_from_driver_roots(result));
    CHECK_FALSE(built_from_driver_roots(llvmpipe()));
    CHECK_THAT(describe(profile),
               Catch::StartsWith("nvidia: dot fma(z, fma(y, x)), ULP off: a/b 2, 1/b 1, sqrt 3, inversesqrt 2, "
                                 "length 2, normalize 3, fragment a/b 2, fragment 1/b 1, subnormals flushed"));
}

TEST_CASE("profiles: the known ones are what the spec's columns give") {
    CHECK(computes_alike(profile_from(llvmpipe()), named_profile("llvmpipe")));
    CHECK(computes_alike(profile_from(nvidia()), named_profile("nvidia")));
    CHECK_FALSE(computes_alike(named_profile("llvmpipe"), named_profile("nvidia")));
}

TEST_CASE("profiles: an operation that is off in the fragment stage alone is off there alone") {
    ProbeResult result = llvmpipe();
    be_off(result, "fragment a/b", 2);
    const Profile profile = profile_from(result);
    CHECK(profile.name == "generic");
    CHECK(profile.errors.divide == 0);
    CHECK(profile.errors.fragment_divide == 2);
    CHECK(profile.not_followed.empty());
    CHECK(measured_operations(profile).divide);
    CHECK_FALSE(measured_operations(profile).interpolation);
    CHECK_THAT(describe(profile), Catch::Contains("ULP off: fragment a/b 2"));
    result = llvmpipe();
    be_off(result, "a/b, precise", 2);
    CHECK_FALSE(measured_operations(profile_from(result)).divide);
    CHECK(measured_operations(profile_from(result)).interpolation);
    result = llvmpipe();
    find(result, "fragment a*b+c, precise", "fused");
    CHECK(measured_operations(profile_from(result)).sums);
    CHECK_FALSE(measured_operations(profile_from(result)).interpolation);
}

TEST_CASE("profiles: in the compute stage sums flush subnormals as products do, or the row is not followed") {
    ProbeResult result = llvmpipe();
    for (const char* name : {"compute: subnormal operand of *", "compute: subnormal result of *"})
        result.rows.push_back({name, "kept", 1, 1, 0, {{"flushed", 0, 0}, {"kept", 1, 0}}});
    result.rows.push_back({"compute: subnormal operand of +", "kept", 1, 1, 0, {}});
    result.rows.push_back({"compute: subnormal result of +", "flushed", 1, 1, 0, {}});
    CHECK(profile_from(result).not_followed == std::vector<std::string>{"compute: subnormal result of +"});
    result.rows.back().finding = "kept";
    CHECK(profile_from(result).not_followed.empty());
}

TEST_CASE("profiles: what the compute stage computes otherwise is open there, and only there") {
    const auto with = [](const char* row, const char* finding) {
        ProbeResult result = llvmpipe();
        result.rows.push_back({row, finding, 1, 1, 0, {}});
        return profile_from(result);
    };
    const Profile same = with("compute: length", "as in the vertex stage");
    CHECK(same.not_followed.empty());
    const Profile other = with("compute: length", "none known");
    CHECK(other.not_followed == std::vector<std::string>{"compute: length"});
    CHECK(other.name == "llvmpipe");
    const KnownOperations known = measured_operations(other);
    CHECK(known.square_root);
    CHECK_FALSE(in_compute_stage(known, other).square_root);
    CHECK(in_compute_stage(known, other).divide);
    CHECK(in_compute_stage(known, same).square_root);
    const Profile fused = with("compute: a*b+c, in functions", "fused");
    CHECK(measured_operations(fused).sums);
    CHECK_FALSE(in_compute_stage(measured_operations(fused), fused).sums);
}

TEST_CASE("profiles: a compute stage that compares subnormals otherwise than it computes leaves them open there") {
    ProbeResult result = llvmpipe();
    for (const char* name : {"compute: subnormal operand of *", "compute: subnormal result of *"})
        result.rows.push_back({name, "kept", 1, 1, 0, {{"flushed", 0, 0}, {"kept", 1, 0}}});
    result.rows.push_back({"compute: subnormal < 0", "kept", 1, 1, 0, {}});
    const Profile same = profile_from(result);
    CHECK(in_compute_stage(measured_operations(same), same).subnormals);
    result.rows.back().finding = "flushed";
    const Profile other = profile_from(result);
    CHECK(other.not_followed == std::vector<std::string>{"compute: subnormal < 0"});
    CHECK(measured_operations(other).subnormals);
    CHECK_FALSE(in_compute_stage(measured_operations(other), other).subnormals);
    for (ProbeRow& row : result.rows)
        if (row.name == "compute: subnormal result of *")
            row.finding = "flushed";
    result.rows.back().finding = "kept";
    const Profile mixed = profile_from(result);
    CHECK(mixed.not_followed.empty());
    CHECK_FALSE(in_compute_stage(measured_operations(mixed), mixed).subnormals);
}

TEST_CASE("profiles: a stage that takes factors in another order has that open, and the compute stage with it") {
    const auto with = [](const char* row, const char* finding) {
        ProbeResult result = llvmpipe();
        result.rows.push_back({row, finding, 1, 1, 0, {}});
        return profile_from(result);
    };
    CHECK_FALSE(measured_operations(with("v*s*t, in functions", "as written")).factors_reordered);
    const Profile vertex = with("v*s*t, in functions", "v*(s*t)");
    CHECK(vertex.name == "llvmpipe");
    CHECK(measured_operations(vertex).factors_reordered);
    CHECK(measured_operations(vertex).sums);
    CHECK(in_compute_stage(measured_operations(vertex), vertex).factors_reordered);
    const Profile compute = with("compute: v*s/t, in functions", "none known");
    CHECK_FALSE(measured_operations(compute).factors_reordered);
    CHECK(in_compute_stage(measured_operations(compute), compute).factors_reordered);
}

TEST_CASE("profiles: a chain that divides exactly is neither known one") {
    ProbeResult result = llvmpipe();
    find(result, "dot(vec3)", "fma(z,fma(y,x))");
    find(result, "dot(vec3), precise", "fma(z,fma(y,x))");
    const Profile profile = profile_from(result);
    CHECK(profile.name == "generic");
    CHECK(profile.dot == DotOrder::fused_chain);
    CHECK(profile.not_followed.empty());
}

TEST_CASE("profiles: an NVIDIA with a root that is never off is not the one measured") {
    ProbeResult result = nvidia();
    for (const char* name : {"sqrt", "sqrt, precise", "fragment sqrt"})
        find(result, name, "rounded");
    CHECK(profile_from(result).name == "generic");
}

TEST_CASE("profiles: rules the reference has are followed") {
    ProbeResult result = llvmpipe();
    find(result, "dot(vec3)", "(x+y)+z");
    find(result, "dot(vec3), precise", "(x+y)+z");
    for (const char* name :
         {"subnormal operand of *", "subnormal result of *", "subnormal operand of +", "subnormal result of +"})
        find(result, name, "kept");
    find(result, "subnormal > 0", "kept");
    find(result, "points: edge in x", "upper pixel");
    find(result, "points: edge in y", "upper pixel");
    find(result, "points: sub-pixel bits", "4");
    find(result, "triangles: sub-pixel bits", "4");
    find(result, "points: snap", "half up");
    find(result, "triangles: snap", "down");
    find(result, "triangles: left side", "out");
    find(result, "triangles: right side", "in");
    find(result, "triangles: lower side", "out");
    find(result, "triangles: upper side", "in");
    find(result, "points: viewport", "fma(clip*(1/w), scale, offset)");
    find(result, "triangles: viewport", "fma(clip*(1/w), scale, offset)");
    const Profile profile = profile_from(result);
    CHECK(profile.name == "generic");
    CHECK(profile.not_followed.empty());
    CHECK(profile.dot == DotOrder::left_to_right);
    CHECK_FALSE(profile.flush_subnormals);
    RasterRules expected;
    expected.subpixel_bits = 4;
    expected.point_snap = SnapRounding::half_up;
    expected.vertex_snap = SnapRounding::down;
    expected.viewport = expected.vertex_viewport = ViewportRounding::fused;
    expected.point_edge_to_lower = expected.left_edge_in = expected.lower_edge_in = false;
    CHECK(profile.raster == expected);
    CHECK(describe(profile) == "generic: dot (x + y) + z, division and roots rounded, subnormals kept, "
                               "4 sub-pixel bits, points on an edge to the upper pixel");
}

TEST_CASE("profiles: of a sum that is nothing known the closest order is taken, and that is told") {
    ProbeResult result = llvmpipe();
    ProbeRow& dot = row(result, "dot(vec3)");
    dot.finding = none_known;
    dot.candidates = {{"(x+y)+z", 70, 9}, {"x+(y+z)", 40, 9}, {"fma(z,fma(y,x))", 50, 9}};
    const Profile profile = profile_from(result);
    CHECK(profile.name == "generic");
    CHECK(profile.dot == DotOrder::right_to_left); // the precise row's
    CHECK(profile.other_orders.dot == std::vector{DotOrder::left_to_right});
    CHECK(profile.not_followed == std::vector<std::string>{"dot(vec3)"});
    CHECK_THAT(describe(profile), Catch::EndsWith("; not followed: dot(vec3)"));
}

TEST_CASE("profiles: what the reference cannot follow is told, each by itself") {
    const std::pair<const char*, const char*> odd[] = {
        {"mat4*vec4, precise", "fma(x,fma(y,fma(z,w)))"},
        {"mat4*vec4 written out, precise", "x+(y+(z+w))"},
        {"x*x+y*y+z*z, precise", "x+(y+z)"},
        {"a*b+c, precise", "fused"},
        {"x*a+x*b, precise", "x*(a+b)"},
        {"cross, precise", "fma(p,q,-r*s)"},
        {"fragment a*b+c, precise", "fused"},
        {"subnormal operand of *", "kept"},
        {"subnormal result of +", "flushed to +0"},
        {"subnormal > 0", "kept"},
        {"subnormal passed on", "flushed"},
        {"transform feedback order", "none known"},
        {"points: edge in y", "upper pixel"},
        {"triangles: sub-pixel bits", "4"},
        {"triangles: right side", "in"},
        {"triangles: upper side", "in"},
        {"equal depth, LESS", "last wins"},
    };
    for (const auto& [name, finding] : odd) {
        INFO(name);
        ProbeResult result = llvmpipe();
        find(result, name, finding);
        const Profile profile = profile_from(result);
        CHECK(profile.name == "generic");
        CHECK(profile.not_followed == std::vector<std::string>{name});
    }
}

TEST_CASE(
    "profiles: every row of the probe takes away what it is about where it is not followed, and never everything") {
    ProbeResult whole = llvmpipe();
    const auto add = [&](std::string_view name, std::string_view finding) {
        if (!whole.has(std::string(name)))
            whole.rows.push_back(found(std::string(name), std::string(finding)));
    };
    for (const test::ExpectedRow& row : test::llvmpipe_rows)
        add(row.name, row.finding);
    for (const test::ProcessorRow& row : test::processor_rows)
        add(row.name, row.fused);
    std::size_t noted = 0;
    const std::vector<ProbeRow> rows = whole.rows;
    for (const ProbeRow& row : rows) {
        INFO(row.name);
        ProbeResult result = whole;
        for (ProbeRow& other : result.rows)
            if (other.name == row.name)
                other.finding = none_known;
        const Profile profile = profile_from(result);
        if (std::ranges::find(profile.not_followed, row.name) == profile.not_followed.end())
            continue;
        ++noted;
        const KnownOperations known = measured_operations(profile);
        CHECK((known.sums || known.divide));
    }
    CHECK(noted > 40);
}

TEST_CASE("profiles: of a depth that is nothing known the closest is taken, and that is told") {
    ProbeResult result = llvmpipe();
    ProbeRow& depth = row(result, "points: depth");
    depth.finding = none_known;
    depth.candidates = {{"(clip*(1/w))*0.5 + 0.5", 40, 1}, {"(clip*r)*0.5 + 0.5, r the driver's 1/w", 70, 1}};
    const Profile profile = profile_from(result);
    CHECK(profile.raster.depth_by_driver_reciprocal);
    CHECK(profile.not_followed == std::vector<std::string>{"points: depth"});
}

TEST_CASE("profiles: subnormals in compute shaders are followed where there are compute shaders") {
    ProbeResult result = llvmpipe();
    CHECK_FALSE(profile_from(result).compute_flush_subnormals);
    for (const char* name : {"compute: subnormal operand of *", "compute: subnormal result of *"})
        find(result, name, "flushed");
    CHECK(profile_from(result).compute_flush_subnormals);
    std::erase_if(result.rows, [](const ProbeRow& r) { return r.name.starts_with("compute"); });
    CHECK(profile_from(result).name == "llvmpipe");
    CHECK(profile_from(result).not_followed.empty());
}

TEST_CASE("profiles: NaN against a number is told as such") {
    ProbeResult result = llvmpipe();
    be_off(result, "sqrt", INT64_MAX);
    CHECK_THAT(describe(profile_from(result)), Catch::Contains("ULP off: sqrt NaN"));
}

TEST_CASE("profiles: a probe without one of the rows is an error") {
    ProbeResult result = llvmpipe();
    result.rows.pop_back();
    CHECK_THROWS_WITH(profile_from(result), "probe: there is no row 'equal depth, LESS'");
}

} // namespace lockstep::test::profiles_test
