#include "crosscheck/record/capsule_parts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::size_t reciprocals = std::size_t{1} << 23U;
constexpr std::size_t inverse_sqrts = std::size_t{1} << 24U;

constexpr std::pair<std::string_view, bool KnownOperations::*> known_table[] = {
    {"sums", &KnownOperations::sums},
    {"divide", &KnownOperations::divide},
    {"square_root", &KnownOperations::square_root},
    {"dot", &KnownOperations::dot},
    {"normalize", &KnownOperations::normalize},
    {"subnormals", &KnownOperations::subnormals},
    {"points", &KnownOperations::points},
    {"factors_reordered", &KnownOperations::factors_reordered},
    {"interpolation", &KnownOperations::interpolation}};

constexpr std::pair<std::string_view, bool KnownRaster::*> raster_table[] = {
    {"point_window", &KnownRaster::point_window},
    {"point_grid", &KnownRaster::point_grid},
    {"point_edges", &KnownRaster::point_edges},
    {"point_depth", &KnownRaster::point_depth},
    {"triangle_window", &KnownRaster::triangle_window},
    {"triangle_grid", &KnownRaster::triangle_grid},
    {"triangle_sides", &KnownRaster::triangle_sides},
    {"point_window_accurate", &KnownRaster::point_window_accurate},
    {"corner_window_accurate", &KnownRaster::corner_window_accurate}};

/// What is known unless it is said that it is not.
constexpr std::pair<std::string_view, bool KnownRaster::*> unknown_table[] = {
    {"equal_depth_unknown", &KnownRaster::equal_depth}, {"gl_grid_unknown", &KnownRaster::gl_grid}};

constexpr std::pair<std::string_view, bool DriverConverts::*> converts_table[] = {
    {"converts_particles", &DriverConverts::particles},
    {"converts_triangles", &DriverConverts::triangles},
    {"converts_vertices", &DriverConverts::vertices}};

/// Calls visit(name, value, value when the name stands in the list) for all of `known`, the values by reference.
template <class Known, class Visit> void for_each_known(Known& known, const Visit& visit) {
    for (const auto& [name, operation] : known_table)
        visit(name, known.*operation, true);
    for (const auto& [name, part] : raster_table)
        visit(name, known.raster.*part, true);
    for (const auto& [name, part] : unknown_table)
        visit(name, known.raster.*part, false);
    for (const auto& [name, kind] : converts_table)
        visit(name, known.converts.*kind, true);
}

/// Index and value of what was looked up in a table.
using Lookups = std::map<std::size_t, float>;

json lookups_json(const Lookups& lookups) {
    json list = json::array();
    for (const auto& [index, value] : lookups)
        list.push_back({index, words_text(std::array{std::bit_cast<std::uint32_t>(value)})});
    return list;
}

std::vector<float> read_lookups(const JsonValue& value, std::size_t count) {
    std::vector<float> table(count, std::numeric_limits<float>::quiet_NaN());
    for (const JsonValue& item : value.items()) {
        const std::vector<JsonValue> parts = item.items();
        if (parts.size() != 2)
            item.fail("not [index, value]");
        table[static_cast<std::size_t>(parts[0].integer(0, static_cast<std::int64_t>(count) - 1))] =
            std::bit_cast<float>(read_words(parts[1], 1).front());
    }
    return table;
}

} // namespace

std::string words_text(std::span<const std::uint32_t> words) { return fmt::format("{:08x}", fmt::join(words, " ")); }

std::vector<std::uint32_t> read_words(const JsonValue& value, std::size_t count) {
    const std::string text = value.text();
    std::vector<std::uint32_t> words;
    for (std::size_t at = 0; at < text.size(); at += 9) {
        std::uint32_t word = 0;
        const char* first = text.data() + at;
        const char* last = first + std::min<std::size_t>(8, text.size() - at);
        const auto [end, status] = std::from_chars(first, last, word, 16);
        if (status != std::errc{} || end != first + 8 || (at + 8 < text.size() && text[at + 8] != ' '))
            value.fail("not groups of eight hexadecimal digits, a space between them");
        words.push_back(word);
    }
    if (count != 0 && words.size() != count)
        value.fail(fmt::format("{} groups of eight hexadecimal digits, to be {}", words.size(), count));
    return words;
}

json known_json(const KnownOperations& known) {
    json list = json::array();
    for_each_known(known, [&](std::string_view name, bool value, bool if_listed) {
        if (value == if_listed)
            list.push_back(name);
    });
    return list;
}

KnownOperations read_known(const JsonValue& value) {
    KnownOperations known{.sums = false};
    std::vector<std::string_view> names;
    for_each_known(known, [&](std::string_view name, bool, bool) { names.push_back(name); });
    for (const JsonValue& item : value.items()) {
        const std::string_view listed = names[item.choice(names)];
        for_each_known(known, [&](std::string_view name, bool& known_value, bool if_listed) {
            if (name == listed)
                known_value = if_listed;
        });
    }
    return known;
}

json roots_json(const Profile& profile, const std::function<void(const Profile&)>& judge) {
    if (!profile.roots)
        return nullptr;
    Lookups reciprocal, inverse_sqrt;
    auto tables = std::make_shared<RootTables>(*profile.roots);
    tables->on_lookup = [&](const std::vector<float>& table, std::size_t index) {
        (&table == &tables->reciprocal ? reciprocal : inverse_sqrt)[index] = table[index];
    };
    Profile watched = profile;
    watched.roots = tables;
    judge(watched);
    tables->on_lookup = {};
    return {{"reciprocal", lookups_json(reciprocal)}, {"inverse_sqrt", lookups_json(inverse_sqrt)}};
}

std::shared_ptr<const RootTables> read_roots(const JsonValue& roots) {
    if (roots.is_null())
        return nullptr;
    roots.check_keys({"reciprocal", "inverse_sqrt"});
    return std::make_shared<const RootTables>(RootTables{read_lookups(roots.at("reciprocal"), reciprocals),
                                                         read_lookups(roots.at("inverse_sqrt"), inverse_sqrts)});
}

} // namespace lockstep
