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
    {"factors_reordered", &KnownOperations::factors_reordered}};

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
    for (const auto& [name, operation] : known_table)
        if (known.*operation)
            list.push_back(name);
    return list;
}

KnownOperations read_known(const JsonValue& value) {
    KnownOperations known{.sums = false};
    std::vector<std::string_view> names;
    for (const auto& [name, operation] : known_table)
        names.push_back(name);
    for (const JsonValue& item : value.items())
        known.*known_table[item.choice(names)].second = true;
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
