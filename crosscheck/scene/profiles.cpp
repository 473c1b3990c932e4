#include "crosscheck/scene/profiles.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/kept_probe.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/probe/root_tables.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/spirv_module.hpp"
#include "reference/legal_interpolation.hpp"
#include "reference/paired_rows.hpp"

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
        const auto matched = [&](const char* name) {
            const auto found = std::find_if(row.candidates.begin(), row.candidates.end(),
                                            [&](const ProbeCandidate& c) { return c.name == name; });
            return found == row.candidates.end() ? 0 : found->matched;
        };
        return std::max_element(known.begin(), known.end(),
                                [&](const auto& a, const auto& b) { return matched(a.first) < matched(b.first); })
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
        if (!is_noted(row_name))
            not_followed.emplace_back(row_name);
    }
    [[nodiscard]] bool is_noted(std::string_view row_name) const {
        return std::ranges::find(not_followed, row_name) != not_followed.end();
    }

    std::vector<std::string> not_followed;

  private:
    const ProbeResult& result_;
};

/// What a row about sums found: a shader gets the first of the driver's candidates that all inputs match.
std::optional<DotOrder> order_named(std::string_view name) {
    const auto names = dot_order_names();
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<DotOrder>(found - names.begin()));
}

/// The order inside one of `forms`, "sqrt({}), rounded": "dot" stands for the driver's own dot of the same qualifier.
std::optional<DotOrder> order_inside(std::string_view finding, std::initializer_list<std::string_view> forms,
                                     DotOrder dot) {
    for (const std::string_view form : forms) {
        const std::size_t hole = form.find("{}");
        const std::string_view before = form.substr(0, hole);
        const std::string_view after = form.substr(hole + 2);
        if (!finding.starts_with(before) || !finding.ends_with(after) || finding.size() < before.size() + after.size())
            continue;
        const auto inside = finding.substr(before.size(), finding.size() - before.size() - after.size());
        if (inside == "dot")
            return dot;
        if (const auto order = order_named(inside))
            return order;
    }
    return {};
}

/// The orders of the sums in the three functions.
struct SumOrders {
    DotOrder dot, length, normalize;
};

/// What the rows found with a qualifier: ", precise" or nothing.
SumOrders orders_with(const std::string& qualifier, Translation& rows, const ProbeResult& result) {
    std::vector<std::pair<const char*, DotOrder>> known;
    for (const std::string_view name : dot_order_names())
        known.emplace_back(name.data(), *order_named(name));
    const DotOrder dot = rows.pick<DotOrder>(("dot(vec3)" + qualifier).c_str(), known);
    const auto inside = [&](const char* function, std::string_view rounded, std::string_view by_tables) {
        const std::string_view form = built_from_driver_roots(result) ? by_tables : rounded;
        return order_inside(result.row(function + qualifier).finding, {form}, dot).value_or(dot);
    };
    return {dot, inside("length", "sqrt({}), rounded", "1/y, y inversesqrt({})"),
            inside("normalize", "v*(1/sqrt({})), rounded", "v*inversesqrt({})")};
}

/// `own` are followed, `others` are legal, too.
void set_orders(Profile& profile, const SumOrders& own, const SumOrders& others) {
    const auto note = [](std::vector<DotOrder>& all, DotOrder of_own, DotOrder other) {
        if (other != of_own && std::find(all.begin(), all.end(), other) == all.end())
            all.push_back(other);
    };
    const auto apart = [&](DotOrder order) { return order != own.dot ? std::optional(order) : std::nullopt; };
    profile.dot = own.dot;
    profile.length_dot = apart(own.length);
    profile.normalize_dot = apart(own.normalize);
    OtherOrders& all = profile.other_orders = {};
    note(all.dot, own.dot, others.dot);
    note(all.length, own.length, others.length);
    note(all.normalize, own.normalize, others.normalize);
    note(all.dot, own.dot, own.length);
    note(all.dot, own.dot, own.normalize);
}

/// The sums in dot, length and normalize as with `precise`; those without are legal.
void follow_orders(Translation& rows, const ProbeResult& result, Profile& profile) {
    const SumOrders precise = orders_with(", precise", rows, result);
    set_orders(profile, precise, orders_with("", rows, result));
}

/// The other way around, of a stage that says `precise` of nothing.
void follow_plain_orders(const ProbeResult& result, Profile& profile) {
    Translation rows(result); // what is not followed is noted already
    const SumOrders plain = orders_with("", rows, result);
    set_orders(profile, plain, orders_with(", precise", rows, result));
}

using Modules = std::vector<std::shared_ptr<const SpirvModule>>;

/// Of stages that are SPIR-V modules, which go another way through a driver than GLSL does: Mesa sums in an order of
/// its own there, and makes normalize a quotient.
void follow_modules(const Modules& modules, const ProbeResult& result, Profile& profile) {
    const auto fail = [&](std::string_view function) {
        for (const char* stage : {"", "compute: "})
            profile.not_followed.push_back(fmt::format("{}{}", stage, function));
    };
    if (!result.has("module: normalize"))
        return fail("normalize");
    const auto found = [&](const char* row, DotOrder in_glsl,
                           std::initializer_list<std::string_view> forms) -> std::optional<DotOrder> {
        const std::string& finding = result.row(row).finding;
        return finding == "as in GLSL" ? in_glsl : order_inside(finding, forms, profile.dot);
    };
    const auto dot = found("module: dot(vec3)", profile.dot, {"{}"}),
               length = found("module: length", profile.length_order(), {"sqrt({}), rounded"}),
               normalize = found("module: normalize", profile.normalize_order(),
                                 {"v*(1/sqrt({})), rounded", "v/sqrt({}), rounded"});
    for (const auto& [function, order] : {std::pair{"dot(vec3)", dot}, {"length", length}, {"normalize", normalize}})
        if (!order)
            fail(function);
    const SumOrders own{dot.value_or(profile.dot), length.value_or(profile.length_order()),
                        normalize.value_or(profile.normalize_order())};
    const auto any = [&](bool SpirvModule::*calls) {
        return std::ranges::any_of(modules, [&](const auto& module) { return (*module).*calls; });
    };
    profile.normalize_divides =
        result.row("module: normalize").finding.starts_with("v/") && any(&SpirvModule::calls_normalize);
    if (profile.normalize_divides && any(&SpirvModule::calls_inverse_sqrt))
        fail("normalize"); // a direction may be made in either way
    set_orders(profile, own, own);
}

/// 0 where an order of the sum inside is all that is to be followed.
std::int64_t error_inside(const Translation& rows, const ProbeResult& result,
                          std::initializer_list<const char*> row_names, std::string_view from, std::string_view form) {
    std::int64_t largest = 0;
    for (const char* row : row_names)
        if (!order_inside(result.row(row).finding, {form}, DotOrder::left_to_right))
            largest = std::max(largest, rows.error({row}, from));
    return largest;
}

OperationErrors errors(const Translation& rows, const ProbeResult& result) {
    OperationErrors e;
    e.divide = rows.error({"a/b", "a/b, precise"}, "rounded");
    e.reciprocal = rows.error({"1/b", "1/b, precise"}, "rounded");
    e.fragment_divide = rows.error({"fragment a/b"}, "rounded");
    e.fragment_reciprocal = rows.error({"fragment 1/b"}, "rounded");
    e.sqrt = rows.error({"sqrt", "sqrt, precise"}, "rounded");
    e.inverse_sqrt = rows.error({"inversesqrt", "inversesqrt, precise"}, "1/sqrt(x), each rounded");
    e.length = error_inside(rows, result, {"length", "length, precise"}, "sqrt(dot), rounded", "sqrt({}), rounded");
    e.normalize = error_inside(rows, result, {"normalize", "normalize, precise"}, "v*(1/sqrt(dot)), rounded",
                               "v*(1/sqrt({})), rounded");
    return e;
}

std::vector<std::pair<const char*, ViewportRounding>> viewports() {
    return {{"(clip*(1/w))*scale + offset", ViewportRounding::separate},
            {"fma(clip*(1/w), scale, offset)", ViewportRounding::fused},
            {"(clip*scale)*(1/w) + offset", ViewportRounding::scaled}};
}

std::vector<std::pair<const char*, bool>> depths() {
    return {{"(clip*(1/w))*0.5 + 0.5", false}, {"(clip*r)*0.5 + 0.5, r the driver's 1/w", true}};
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
    rules.viewport = rows.pick("points: viewport", viewports());
    rules.vertex_viewport = rows.pick("triangles: viewport", viewports());
    rules.point_edge_to_lower =
        rows.pick<bool>("points: edge in x", "points: edge in y", {{"lower pixel", true}, {"upper pixel", false}});
    rules.left_edge_in = rows.pick<bool>("triangles: left side", {{"in", true}, {"out", false}});
    rules.lower_edge_in = rows.pick<bool>("triangles: lower side", {{"in", true}, {"out", false}});
    rows.require({"triangles: right side"}, rules.left_edge_in ? "out" : "in");
    rows.require({"triangles: upper side"}, rules.lower_edge_in ? "out" : "in");
    rules.depth_by_driver_reciprocal = rows.pick("points: depth", depths());
    rows.require({"equal depth, LESS"}, "first stays");
    return rules;
}

/// Null where an older probe did not look.
std::optional<bool> found(const ProbeResult& result, std::string_view row, std::string_view finding) {
    return result.has(row) ? std::optional(result.row(row).finding == finding) : std::nullopt;
}

bool has_geometry_stage(const std::filesystem::path& shaders) {
    constexpr std::array stages{Stage::geometry};
    return !load_stages(collision_shaders(shaders), "collision_pass", stages).empty();
}

/// A pass that computes particles, in the first of its stages.
struct Computing {
    std::string_view pass;
    std::span<const Stage> stages;
};
constexpr std::array drawing{Stage::vertex, Stage::geometry, Stage::fragment};
constexpr std::array vertices{Stage::vertex}, alone{Stage::compute};
constexpr std::array computing{Computing{"collision_pass", drawing}, Computing{"collision_pass", alone},
                               Computing{"layered_collision_pass", vertices}, Computing{"octree_pass", alone},
                               Computing{"depth_pass", alone}};

/// Whether one of them says `precise` of nothing; a copy of a shipped one says it.
bool lacks_precise(const std::filesystem::path& shaders) {
    return !shaders.empty() && std::ranges::any_of(computing, [&](const Computing& of) {
        return !says_precise(load_stage(collision_shaders(shaders), of.pass, of.stages.front()));
    });
}

/// Whether another one than a shipped one says it.
bool says_precise_too(const std::filesystem::path& shaders) {
    return std::ranges::any_of(computing, [&](const Computing& of) {
        const auto stage = [&](const std::filesystem::path& folder) {
            return load_stage(collision_shaders(folder), of.pass, of.stages.front());
        };
        const ShaderSource own = stage(shaders);
        return says_precise(own) && own.text != stage({}).text;
    });
}

/// The SPIR-V modules that compute particles: beside a stage in GLSL one is translated, and is none.
Modules computing_modules(const std::filesystem::path& shaders) {
    Modules modules;
    for (const Computing& of : shaders.empty() ? std::span<const Computing>() : computing) {
        const auto stages = load_stages(collision_shaders(shaders), of.pass, of.stages);
        if (std::ranges::all_of(stages, [](const ShaderSource& one) { return one.module != nullptr; }))
            modules.push_back(stages.front().module);
    }
    return modules;
}

/// Whether the obstacles' vertex stage redeclares gl_Position neither precise nor invariant. What is precise elsewhere
/// and copied to it is fused all the same (NVIDIA 580).
bool leaves_corners_open(const std::filesystem::path& shaders) {
    if (shaders.empty())
        return false;
    const ShaderSource stage = load_stage(collision_shaders(shaders), "obstacle_pass", Stage::vertex);
    ShaderWords words(stage.text);
    std::string before;
    for (; words.next(); before = words.token())
        if (words.token() == "gl_Position" && (before == "precise" || before == "invariant"))
            return false;
    return true;
}

/// Whether sums without `precise` are not the ones written.
bool fuses_without_precise(const ProbeResult& result) {
    const auto is_fused = [&](const char* row) { return result.has(row) && result.row(row).finding != "each rounded"; };
    return is_fused("a*b+c") || is_fused("cross");
}

/// Findings that differ in the rounding of what lies halfway between two codes alone.
constexpr std::array<std::string_view, 3> unorm8_nearest{"nearest", "rint(x*255)", "floor(x*255+0.5)"};

/// Rules out the ways that the probe did not find, of those of which a driver has one (reference/paired_rows.hpp). A
/// row that an older probe has not rules out nothing.
void note_pairs(Translation& rows, const ProbeResult& result) {
    struct Found {
        const char* row;
        std::string_view finding;
    };
    const auto note = [&](const PairedRows& pair, std::initializer_list<Found> first,
                          std::initializer_list<Found> second) {
        if (!std::ranges::all_of(first, [&](const Found& one) { return result.has(one.row); }))
            return;
        for (const auto& [name, all] : {std::pair{pair.first, first}, {pair.second, second}})
            if (!std::ranges::all_of(all, [&](const Found& one) { return result.row(one.row).finding == one.finding; }))
                rows.note(name.data());
    };
    note(drawn_half_rows,
         {{"float to half", "nearest even"},
          {"float to subnormal half", "nearest even"},
          {"float above the largest half", "infinite"}},
         {{"float to half", "truncate"},
          {"float to subnormal half", "truncate"},
          {"float above the largest half", "largest"}});
    note(stored_half_rows,
         {{"image: store to half", "nearest even"},
          {"image: store to subnormal half", "nearest even"},
          {"image: store above the largest half", "infinite"}},
         {{"image: store to half", "truncate"},
          {"image: store to subnormal half", "truncate"},
          {"image: store above the largest half", "largest"}});
    const char* const unorm8 = "float to unorm8";
    const bool is_nearest = result.has(unorm8) && std::ranges::any_of(unorm8_nearest, [&](std::string_view finding) {
                                return result.row(unorm8).finding == finding;
                            });
    note(drawn_unorm8_rows, {{unorm8, is_nearest ? std::string_view(result.row(unorm8).finding) : unorm8_nearest[0]}},
         {{unorm8, "truncate"}});
    note(brink_rows, {{brink_rows.first.data(), "all, as GL says"}},
         {{brink_rows.second.data(), "where the grid puts them"}});
}

/// Rows on which passes of some systems rest, with the findings that their twins follow. A result of an older probe
/// has none of them.
void note_images(Translation& rows, const ProbeResult& result) {
    const auto follow = [&](const char* row, std::initializer_list<std::string_view> findings) {
        if (result.has(row) && std::ranges::find(findings, result.row(row).finding) == findings.end())
            rows.note(row);
    };
    follow("image: blend rgba32f", {"each sum rounded, in order"});
    follow("image: blend rgba16f", {"each sum truncated", "each sum nearest even"});
    for (const auto& [row, other_way] :
         {std::pair{"image: linear filter", "image: linear filter, aligned"},
          std::pair{"image: linear filter, border of 0", "image: linear filter, aligned, border of 0"}}) {
        follow(row, {"fma(f, b - a, a), all bits", "a + f*(b - a), all bits", "a*(1 - f) + b*f, all bits"});
        const bool is_aligned =
            result.has(other_way) && result.row(other_way).finding == "cell's weights in 256ths, planes cut";
        if (rows.is_noted(row) && !is_aligned)
            rows.note(other_way);
    }
    const char* const plane = "image: linear filter of a plane";
    follow(plane, {"fma(f, b - a, a), all bits", "a + f*(b - a), all bits"});
    if (rows.is_noted(plane))
        follow("image: linear filter of a plane, aligned", {"cell's weights in 256ths, cut"});
    follow("image: sRGB store", {"nearest code"});
    follow("image: gl_PointCoord, accuracy", {"to 1/256 pixel, from above"});
    const char* const cut = "image: gl_PointCoord, cut size";
    if (rows.is_noted("image: gl_PointCoord, accuracy"))
        follow(cut, {"to 2^-20, of a middle on 256ths and a size cut to 32nds"});
    const char* const dropped = "image: points outside, dropped";
    follow(dropped, {"all, as GL says"});
    if (rows.is_noted(dropped))
        follow("image: points beside the image, drawn", {"all whose depth is within the volume"});
    note_pairs(rows, result);
}

} // namespace

Profile profile_from(const ProbeResult& result) {
    Translation rows(result);
    Profile profile;
    profile.name = "generic";
    follow_orders(rows, result, profile);
    rows.require({"mat4*vec4, precise", "mat4*vec4 written out, precise"}, "((x+y)+z)+w");
    rows.require({"x*x+y*y+z*z, precise"}, "(x+y)+z");
    rows.require({"a*b+c, precise", "x*a+x*b, precise", "cross, precise", "fragment a*b+c, precise"}, "each rounded");
    profile.flush_subnormals = rows.pick<bool>("subnormal result of *", {{"flushed", true}, {"kept", false}});
    rows.require({"subnormal operand of *", "subnormal operand of +", "subnormal result of +", "subnormal > 0"},
                 profile.flush_subnormals ? "flushed" : "kept");
    rows.require({"subnormal passed on"}, "kept");
    for (const char* row : {"compute: a/b", "compute: 1/b", "compute: sqrt", "compute: inversesqrt",
                            "compute: dot(vec3)", "compute: length", "compute: normalize"})
        if (result.has(row))
            rows.require({row}, "as in the vertex stage");
    for (const char* row : {"a/c, c constant, precise", "compute: a/c, c constant"})
        if (result.has(row))
            rows.require({row}, "as a/b");
    for (const char* row : {"compute: a*b+c, in functions", "compute: c-a*b, in functions"})
        if (result.has(row))
            rows.require({row}, "each rounded");
    for (const char* stage : {"", "compute: "})
        for (const char* chain : {"v*s*t", "v*s/t", "v/s*t"})
            if (const std::string row = fmt::format("{}{}, in functions", stage, chain); result.has(row))
                rows.require({row.c_str()}, "as written");
    if (result.has("compute: subnormal result of *")) {
        profile.compute_flush_subnormals =
            rows.pick<bool>("compute: subnormal result of *", {{"flushed", true}, {"kept", false}});
        const bool results = profile.compute_flush_subnormals;
        if (result.has("compute: subnormal result of +"))
            rows.require({"compute: subnormal result of +"}, results ? "flushed" : "kept");
        profile.compute_flush_subnormals =
            rows.pick<bool>("compute: subnormal operand of *", {{"flushed", true}, {"kept", false}});
        if (result.has("compute: subnormal operand of +"))
            rows.require({"compute: subnormal operand of +"}, profile.compute_flush_subnormals ? "flushed" : "kept");
        if (result.has("compute: subnormal < 0"))
            rows.require({"compute: subnormal < 0"}, profile.compute_flush_subnormals ? "flushed" : "kept");
        if (results != profile.compute_flush_subnormals)
            profile.compute_flush_results = results;
    }
    rows.require({"transform feedback order"}, "as drawn");
    profile.errors = errors(rows, result);
    profile.raster = raster_rules(rows);
    if (const ContextInfo& gl = result.context; gl.max_point_size > 0.0F) // else an older probe's
        profile.point_sizes = {gl.min_point_size, gl.max_point_size};
    profile.point_window_accurate = found(result, "points: window accuracy", "as GLSL's");
    profile.corner_window_accurate = found(result, "triangles: window accuracy", "as GLSL's");
    note_images(rows, result);
    profile.not_followed = rows.not_followed;
    for (const char* name : {"llvmpipe", "nvidia"})
        if (computes_alike(profile, named_profile(name)))
            profile.name = name;
    return profile;
}

bool built_from_driver_roots(const ProbeResult& result) {
    const auto is = [&](const char* row_name, const char* sequence) {
        const ProbeRow& row = result.row(row_name);
        return std::any_of(row.candidates.begin(), row.candidates.end(),
                           [&](const ProbeCandidate& c) { return c.name == sequence && c.matched == row.total; });
    };
    return result.row("a/b, precise").finding != "rounded" && is("a/b, precise", "a*r, r the driver's 1/b") &&
           is("a/b, b from 2^126, precise", "a*r, r the driver's 1/b") &&
           is("sqrt, precise", "1/y, y the driver's inversesqrt") && is("length, precise", "1/y, y inversesqrt(dot)") &&
           is("normalize, precise", "v*inversesqrt(dot)");
}

Profile measured_profile(const Context& context, const std::filesystem::path& shaders) {
    return measured_profile(kept_probe(context), shaders);
}

Profile measured_profile(const ProbeResult& result, const std::filesystem::path& shaders) {
    Profile profile = profile_from(result);
    if (built_from_driver_roots(result))
        profile.roots = std::make_shared<const RootTables>(measure_root_tables());
    return with_shaders(std::move(profile), result, shaders);
}

Profile with_shaders(Profile profile, const ProbeResult& result, const std::filesystem::path& shaders) {
    const FragmentStage obstacles = fragment_stage(shaders, "obstacle_pass");
    profile.converts = {!fragment_stage(shaders, "collision_pass").encodes, !obstacles.encodes,
                        !fragment_stage(shaders, "obstacle_vertices").encodes};
    if (obstacles.interpolates && profile.follows(driver_interpolates_row))
        profile.not_followed.emplace_back(driver_interpolates_row);
    profile.any_order = fuses_without_precise(result) && lacks_precise(shaders);
    profile.open_corners = fuses_without_precise(result) && leaves_corners_open(shaders);
    if (const Modules modules = computing_modules(shaders); !modules.empty())
        follow_modules(modules, result, profile);
    else if (!profile.any_order && lacks_precise(shaders) && !says_precise_too(shaders))
        follow_plain_orders(result, profile);
    if (has_geometry_stage(shaders))
        return profile;
    // The rows of points behind a geometry stage say nothing of these points.
    std::erase(profile.not_followed, "points: viewport");
    std::erase(profile.not_followed, "points: depth");
    Translation rows(result);
    profile.raster.viewport = rows.pick("points: viewport, no geometry stage", viewports());
    profile.raster.depth_by_driver_reciprocal = rows.pick("points: depth, no geometry stage", depths());
    profile.not_followed.insert(profile.not_followed.end(), rows.not_followed.begin(), rows.not_followed.end());
    return profile;
}

Profile without_precise(Profile profile, const ProbeResult& result, bool said_elsewhere) {
    profile.any_order = fuses_without_precise(result);
    if (!profile.any_order && !said_elsewhere)
        follow_plain_orders(result, profile);
    return profile;
}

} // namespace lockstep
