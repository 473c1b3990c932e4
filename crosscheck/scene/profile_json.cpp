#include "crosscheck/scene/profile_json.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 3> viewport_names{"separate", "fused", "scaled"};
constexpr std::array<std::string_view, 4> snap_names{"half_to_even", "half_away", "half_up", "down"};
constexpr std::array<std::string_view, 2> off_on{"off", "on"};

constexpr std::pair<std::string_view, std::int64_t OperationErrors::*> error_table[] = {
    {"divide", &OperationErrors::divide}, {"reciprocal", &OperationErrors::reciprocal},
    {"sqrt", &OperationErrors::sqrt},     {"inverse_sqrt", &OperationErrors::inverse_sqrt},
    {"length", &OperationErrors::length}, {"normalize", &OperationErrors::normalize}};

/// Older recordings have them in the vertex stage's.
constexpr std::pair<std::string_view, std::int64_t OperationErrors::*> fragment_error_table[] = {
    {"fragment_divide", &OperationErrors::fragment_divide},
    {"fragment_reciprocal", &OperationErrors::fragment_reciprocal}};

constexpr std::array<std::string_view, 3> converted_names{"particles", "triangles", "vertices"};
constexpr bool DriverConverts::*converted_table[] = {&DriverConverts::particles, &DriverConverts::triangles,
                                                     &DriverConverts::vertices};

constexpr std::pair<std::string_view, std::optional<bool> Profile::*> accuracy_table[] = {
    {"point_window_accurate", &Profile::point_window_accurate},
    {"corner_window_accurate", &Profile::corner_window_accurate}};

constexpr std::pair<std::string_view, bool RasterRules::*> rule_table[] = {
    {"depth_by_driver_reciprocal", &RasterRules::depth_by_driver_reciprocal},
    {"point_edge_to_lower", &RasterRules::point_edge_to_lower},
    {"left_edge_in", &RasterRules::left_edge_in},
    {"lower_edge_in", &RasterRules::lower_edge_in}};

template <class Value> std::string name_of(Names names, Value value) {
    return std::string(names[static_cast<std::size_t>(value)]);
}

template <class Value> void read_named(const JsonValue& parent, std::string_view key, Names names, Value& value) {
    if (const auto found = parent.find(key))
        value = static_cast<Value>(found->choice(names));
}

nlohmann::json raster_json(const RasterRules& rules) {
    nlohmann::json raster{{"subpixel_bits", rules.subpixel_bits},
                          {"point_snap", name_of(snap_names, rules.point_snap)},
                          {"vertex_snap", name_of(snap_names, rules.vertex_snap)},
                          {"viewport", name_of(viewport_names, rules.viewport)}};
    if (rules.vertex_viewport != rules.viewport)
        raster["vertex_viewport"] = name_of(viewport_names, rules.vertex_viewport);
    for (const auto& [name, rule] : rule_table)
        raster[std::string(name)] = name_of(off_on, rules.*rule);
    return raster;
}

void read_raster(const JsonValue& json, RasterRules& rules) {
    json.check_keys({"subpixel_bits", "point_snap", "vertex_snap", "viewport", "vertex_viewport",
                     "depth_by_driver_reciprocal", "point_edge_to_lower", "left_edge_in", "lower_edge_in"});
    if (const auto bits = json.find("subpixel_bits"))
        rules.subpixel_bits = static_cast<int>(bits->integer(4, 12));
    read_named(json, "point_snap", snap_names, rules.point_snap);
    read_named(json, "vertex_snap", snap_names, rules.vertex_snap);
    read_named(json, "viewport", viewport_names, rules.viewport);
    rules.vertex_viewport = rules.viewport;
    read_named(json, "vertex_viewport", viewport_names, rules.vertex_viewport);
    for (const auto& [name, rule] : rule_table)
        read_named(json, name, off_on, rules.*rule);
}

constexpr std::pair<std::string_view, std::vector<DotOrder> OtherOrders::*> other_table[] = {
    {"dot", &OtherOrders::dot}, {"length", &OtherOrders::length}, {"normalize", &OtherOrders::normalize}};

/// Where dot, length and normalize have orders of their own, or others without `precise`.
void add_orders(nlohmann::json& json, const Profile& profile) {
    if (profile.length_dot)
        json["length_dot"] = name_of(dot_order_names(), *profile.length_dot);
    if (profile.normalize_dot)
        json["normalize_dot"] = name_of(dot_order_names(), *profile.normalize_dot);
    for (const auto& [name, orders] : other_table)
        for (const DotOrder order : profile.other_orders.*orders)
            json["other_orders"][std::string(name)].push_back(name_of(dot_order_names(), order));
}

void read_orders(const JsonValue& json, Profile& profile) {
    const auto own = [&](std::string_view key, std::optional<DotOrder>& order) {
        if (const auto found = json.find(key))
            order = static_cast<DotOrder>(found->choice(dot_order_names()));
    };
    own("length_dot", profile.length_dot);
    own("normalize_dot", profile.normalize_dot);
    if (const auto others = json.find("other_orders")) {
        others->check_keys({"dot", "length", "normalize"});
        for (const auto& [name, orders] : other_table)
            if (const auto found = others->find(name))
                for (const JsonValue& order : found->items())
                    (profile.other_orders.*orders).push_back(static_cast<DotOrder>(order.choice(dot_order_names())));
    }
}

Profile base(const JsonValue& json) {
    Profile profile;
    profile.name = json.at("name").label();
    for (const char* known : {"strict", "llvmpipe", "nvidia"})
        if (profile.name == known)
            return named_profile(known);
    return profile;
}

} // namespace

nlohmann::json profile_json(const Profile& profile) {
    nlohmann::json errors = nlohmann::json::object();
    for (const auto& [name, error] : error_table)
        errors[std::string(name)] = profile.errors.*error;
    for (const auto& [name, error] : fragment_error_table)
        errors[std::string(name)] = profile.errors.*error;
    nlohmann::json json{{"name", profile.name},
                        {"dot", name_of(dot_order_names(), profile.dot)},
                        {"flush_subnormals", name_of(off_on, profile.flush_subnormals)},
                        {"compute_flush_subnormals", name_of(off_on, profile.compute_flush_subnormals)},
                        {"raster", raster_json(profile.raster)},
                        {"ulp_errors", errors},
                        {"not_followed", profile.not_followed}};
    add_orders(json, profile);
    for (std::size_t i = 0; i < converted_names.size(); ++i)
        if (profile.converts.*converted_table[i])
            json["driver_converts"].push_back(converted_names[i]);
    for (const auto& [name, accurate] : accuracy_table)
        if (profile.*accurate)
            json[std::string(name)] = name_of(off_on, *(profile.*accurate));
    json["point_sizes"]["smallest"] = profile.point_sizes.smallest;
    if (std::isfinite(profile.point_sizes.largest))
        json["point_sizes"]["largest"] = profile.point_sizes.largest;
    if (profile.normalize_divides)
        json["normalize_divides"] = name_of(off_on, true);
    if (profile.any_order)
        json["any_order"] = name_of(off_on, true);
    if (profile.open_corners)
        json["open_corners"] = name_of(off_on, true);
    if (profile.compute_flush_results)
        json["compute_flush_results"] = name_of(off_on, *profile.compute_flush_results);
    return json;
}

Profile read_profile(const JsonValue& json) {
    json.check_keys({"name", "dot", "length_dot", "normalize_dot", "other_orders", "normalize_divides",
                     "flush_subnormals", "compute_flush_subnormals", "compute_flush_results", "raster", "ulp_errors",
                     "not_followed", "point_window_accurate", "corner_window_accurate", "driver_converts", "any_order",
                     "open_corners", "point_sizes"});
    Profile profile = base(json);
    read_named(json, "dot", dot_order_names(), profile.dot);
    read_orders(json, profile);
    if (json.find("compute_flush_results")) {
        profile.compute_flush_results = false;
        read_named(json, "compute_flush_results", off_on, *profile.compute_flush_results);
    }
    read_named(json, "flush_subnormals", off_on, profile.flush_subnormals);
    read_named(json, "normalize_divides", off_on, profile.normalize_divides);
    read_named(json, "any_order", off_on, profile.any_order);
    read_named(json, "open_corners", off_on, profile.open_corners);
    read_named(json, "compute_flush_subnormals", off_on, profile.compute_flush_subnormals);
    for (const auto& [name, accurate] : accuracy_table) {
        if (json.find("raster")) // an older program's, which did not look
            profile.*accurate = {};
        if (const auto found = json.find(name))
            profile.*accurate = found->choice(off_on) == 1;
    }
    if (const auto raster = json.find("raster"))
        read_raster(*raster, profile.raster);
    if (const auto sizes = json.find("point_sizes")) {
        sizes->check_keys({"smallest", "largest"});
        profile.point_sizes = {};
        if (const auto smallest = sizes->find("smallest"))
            profile.point_sizes.smallest = smallest->number(number::not_negative);
        if (const auto largest = sizes->find("largest"))
            profile.point_sizes.largest = largest->number(number::positive);
        if (profile.point_sizes.largest < profile.point_sizes.smallest)
            sizes->fail("\"largest\" is below \"smallest\"");
    }
    if (const auto errors = json.find("ulp_errors")) {
        errors->check_keys({"divide", "reciprocal", "sqrt", "inverse_sqrt", "length", "normalize", "fragment_divide",
                            "fragment_reciprocal"});
        const auto read = [&](const auto& table) {
            for (const auto& [name, error] : table)
                if (const auto value = errors->find(name))
                    profile.errors.*error = value->integer(0, INT64_MAX);
        };
        read(error_table);
        profile.errors.fragment_divide = profile.errors.divide;
        profile.errors.fragment_reciprocal = profile.errors.reciprocal;
        read(fragment_error_table);
    }
    if (const auto converted = json.find("driver_converts"))
        for (const JsonValue& name : converted->items())
            profile.converts.*converted_table[name.choice(converted_names)] = true;
    if (const auto rows = json.find("not_followed")) {
        profile.not_followed.clear();
        for (const JsonValue& row : rows->items())
            profile.not_followed.push_back(row.label());
    }
    return profile;
}

} // namespace lockstep
