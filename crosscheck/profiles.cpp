#include "crosscheck/profiles.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/probe/root_tables.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep {
namespace {

/// Turns rows into a profile, and notes those that cannot be followed.
class Translation {
  public:
    explicit Translation(const ProbeResult& result) : result_(result) {}

    /// What a row's finding stands for; where none of `known` was found, what comes closest, and a note.
    template <class Value> Value pick(const char* row_name, const std::vector<std::pair<const char*, Value>>& known) {
        const ProbeRow& row = result_.row(row_name);
        for (const auto& [finding, value] : known)
            if (row.finding == finding)
                return value;
        note(row_name);
        return std::max_element(known.begin(), known.end(),
                                [&](const auto& a, const auto& b) {
                                    return candidate(row, a.first).matched < candidate(row, b.first).matched;
                                })
            ->second;
    }

    /// The same of two rows that have to agree; the first one counts.
    template <class Value>
    Value pick(const char* first, const char* second, const std::vector<std::pair<const char*, Value>>& known) {
        const Value value = pick(first, known);
        if (pick(second, known) != value)
            note(second);
        return value;
    }

    void require(std::initializer_list<const char*> row_names, std::string_view finding) {
        for (const char* row_name : row_names)
            if (result_.row(row_name).finding != finding)
                note(row_name);
    }

    /// Largest distance from a candidate over several rows.
    [[nodiscard]] std::int64_t error(std::initializer_list<const char*> row_names, std::string_view from) const {
        std::int64_t largest = 0;
        for (const char* row_name : row_names)
            largest = std::max(largest, candidate(result_.row(row_name), from).max_ulp);
        return largest;
    }

    void note(const char* row_name) {
        if (std::find(not_followed.begin(), not_followed.end(), row_name) == not_followed.end())
            not_followed.emplace_back(row_name);
    }

    std::vector<std::string> not_followed;

  private:
    const ProbeResult& result_;
};

OperationErrors errors(const Translation& rows) {
    OperationErrors e;
    e.divide = rows.error({"a/b", "a/b, precise", "fragment a/b"}, "rounded");
    e.reciprocal = rows.error({"1/b", "1/b, precise", "fragment 1/b"}, "rounded");
    e.sqrt = rows.error({"sqrt", "sqrt, precise", "fragment sqrt"}, "rounded");
    e.inverse_sqrt =
        rows.error({"inversesqrt", "inversesqrt, precise", "fragment inversesqrt"}, "1/sqrt(x), each rounded");
    e.length = rows.error({"length", "length, precise"}, "sqrt(dot), rounded");
    e.normalize = rows.error({"normalize", "normalize, precise"}, "v*(1/sqrt(dot)), rounded");
    return e;
}

RasterRules raster_rules(Translation& rows) {
    const std::vector<std::pair<const char*, SnapRounding>> snaps{{"half to even", SnapRounding::half_to_even},
                                                                  {"half away from zero", SnapRounding::half_away},
                                                                  {"half up", SnapRounding::half_up},
                                                                  {"down", SnapRounding::down}};
    const std::vector<std::pair<const char*, int>> bits{{"4", 4}, {"5", 5},   {"6", 6},   {"7", 7},  {"8", 8},
                                                        {"9", 9}, {"10", 10}, {"11", 11}, {"12", 12}};
    RasterRules rules;
    rules.subpixel_bits = rows.pick("points: sub-pixel bits", "triangles: sub-pixel bits", bits);
    rules.point_snap = rows.pick("points: snap", snaps);
    rules.vertex_snap = rows.pick("triangles: snap", snaps);
    rules.viewport = rows.pick<ViewportRounding>("points: viewport", "triangles: viewport",
                                                 {{"(clip*(1/w))*scale + offset", ViewportRounding::separate},
                                                  {"fma(clip*(1/w), scale, offset)", ViewportRounding::fused},
                                                  {"(clip*scale)*(1/w) + offset", ViewportRounding::scaled}});
    rules.point_edge_to_lower =
        rows.pick<bool>("points: edge in x", "points: edge in y", {{"lower pixel", true}, {"upper pixel", false}});
    rules.left_edge_in = rows.pick<bool>("triangles: left side", {{"in", true}, {"out", false}});
    rules.lower_edge_in = rows.pick<bool>("triangles: lower side", {{"in", true}, {"out", false}});
    rows.require({"triangles: right side"}, rules.left_edge_in ? "out" : "in");
    rows.require({"triangles: upper side"}, rules.lower_edge_in ? "out" : "in");
    rules.depth_by_driver_reciprocal = rows.pick<bool>(
        "points: depth", {{"(clip*(1/w))*0.5 + 0.5", false}, {"(clip*r)*0.5 + 0.5, r the driver's 1/w", true}});
    rows.require({"equal depth, LESS"}, "first stays");
    return rules;
}

bool has_geometry_stage(const std::filesystem::path& shaders) {
    constexpr std::array stages{Stage::geometry};
    return !load_stages(shader_folders(shaders), "collision_pass", stages).empty();
}

std::string errors_text(const OperationErrors& e) {
    const std::pair<const char*, std::int64_t> all[] = {{"a/b", e.divide},    {"1/b", e.reciprocal},
                                                        {"sqrt", e.sqrt},     {"inversesqrt", e.inverse_sqrt},
                                                        {"length", e.length}, {"normalize", e.normalize}};
    std::vector<std::string> off;
    for (const auto& [name, ulp] : all)
        if (ulp > 0)
            off.push_back(fmt::format("{} {}", name, ulp == INT64_MAX ? "NaN" : std::to_string(ulp)));
    return off.empty() ? "division and roots rounded" : fmt::format("ULP off: {}", fmt::join(off, ", "));
}

std::string_view dot_text(DotOrder order) {
    switch (order) {
    case DotOrder::left_to_right:
        return "(x + y) + z";
    case DotOrder::right_to_left:
        return "x + (y + z)";
    case DotOrder::fused_chain:
        return "fma(z, fma(y, x))";
    }
    return "";
}

} // namespace

Profile profile_from(const ProbeResult& result) {
    Translation rows(result);
    Profile profile;
    profile.name = "generic";
    profile.dot = rows.pick<DotOrder>("dot(vec3)", "dot(vec3), precise",
                                      {{"(x+y)+z", DotOrder::left_to_right},
                                       {"x+(y+z)", DotOrder::right_to_left},
                                       {"fma(z,fma(y,x))", DotOrder::fused_chain}});
    rows.require({"mat4*vec4, precise", "mat4*vec4 written out, precise"}, "((x+y)+z)+w");
    rows.require({"x*x+y*y+z*z, precise"}, "(x+y)+z");
    rows.require({"a*b+c, precise", "x*a+x*b, precise", "cross, precise", "fragment a*b+c, precise"}, "each rounded");
    profile.flush_subnormals = rows.pick<bool>("subnormal result of *", {{"flushed", true}, {"kept", false}});
    rows.require({"subnormal operand of *", "subnormal operand of +", "subnormal result of +", "subnormal > 0"},
                 profile.flush_subnormals ? "flushed" : "kept");
    rows.require({"subnormal passed on"}, "kept");
    if (result.has("compute: subnormal result of *")) {
        profile.compute_flush_subnormals =
            rows.pick<bool>("compute: subnormal result of *", {{"flushed", true}, {"kept", false}});
        rows.require({"compute: subnormal operand of *"}, profile.compute_flush_subnormals ? "flushed" : "kept");
    }
    rows.require({"transform feedback order"}, "as drawn");
    profile.errors = errors(rows);
    profile.raster = raster_rules(rows);
    profile.not_followed = rows.not_followed;
    for (const char* name : {"llvmpipe", "nvidia"})
        if (computes_alike(profile, named_profile(name)))
            profile.name = name;
    return profile;
}

bool built_from_driver_roots(const ProbeResult& result) {
    const auto is = [&](const char* row_name, const char* sequence) {
        const ProbeRow& row = result.row(row_name);
        const ProbeCandidate& found = candidate(row, sequence);
        return found.matched == row.total;
    };
    return result.row("a/b, precise").finding != "rounded" && is("a/b, precise", "a*r, r the driver's 1/b") &&
           is("a/b, b from 2^126, precise", "a*r, r the driver's 1/b") &&
           is("sqrt, precise", "1/y, y the driver's inversesqrt") && is("length, precise", "1/y, y inversesqrt(dot)") &&
           is("normalize, precise", "v*inversesqrt(dot)");
}

Profile measured_profile(const Context& context, const std::filesystem::path& shaders) {
    return measured_profile(probe(context), shaders);
}

Profile measured_profile(const ProbeResult& result, const std::filesystem::path& shaders) {
    Profile profile = profile_from(result);
    if (built_from_driver_roots(result))
        profile.roots = std::make_shared<const RootTables>(measure_root_tables());
    return with_shaders(std::move(profile), result, shaders);
}

Profile with_shaders(Profile profile, const ProbeResult& result, const std::filesystem::path& shaders) {
    const char* row = "points: viewport, no geometry stage";
    if (!has_geometry_stage(shaders) && result.row(row).finding != result.row("points: viewport").finding)
        profile.not_followed.emplace_back(row);
    return profile;
}

std::string describe(const Profile& profile) {
    std::string text =
        fmt::format("{}: dot {}, {}, subnormals {}, {} sub-pixel bits, points on an edge to the {} pixel", profile.name,
                    dot_text(profile.dot),
                    profile.roots ? "division and roots by the driver's own tables" : errors_text(profile.errors),
                    profile.flush_subnormals ? "flushed" : "kept", profile.raster.subpixel_bits,
                    profile.raster.point_edge_to_lower ? "lower" : "upper");
    if (!profile.not_followed.empty())
        text += fmt::format("; not followed: {}", fmt::join(profile.not_followed, ", "));
    return text;
}

} // namespace lockstep
