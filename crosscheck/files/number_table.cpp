#include "crosscheck/files/number_table.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20U;

/// As CSV heads it: "velocity.x".
std::string component_name(const TableColumn& column, int component) {
    return column.components == 1 ? column.name : fmt::format("{}.{}", column.name, "xyzw"[component]);
}

/// "a vec3", "an ivec2".
std::string vector_type(const TableColumn& column) {
    const std::string type = glsl_type(Field{.name = {}, .scalar = column.scalar, .components = column.components});
    return column.is_bool ? fmt::format("a bvec{}", column.components)
                          : fmt::format("{} {}", type.front() == 'i' ? "an" : "a", type);
}

std::string_view without_spaces(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

template <class Number, class... Format>
std::optional<Number> number_in(std::string_view digits, const Format&... format) {
    Number number{};
    const char* const end = digits.data() + digits.size();
    const auto [rest, status] = std::from_chars(digits.data(), end, number, format...);
    return status == std::errc{} && rest == end ? std::optional(number) : std::nullopt;
}

} // namespace

std::optional<std::uint32_t> number_bits(std::string_view text, const TableColumn& column) {
    if (column.is_bool) {
        const bool is_true = text == "1" || text == "true";
        return is_true || text == "0" || text == "false" ? std::optional(is_true ? 1U : 0U) : std::nullopt;
    }
    const bool minus = text.starts_with('-');
    if (text.starts_with('+'))
        text.remove_prefix(1);
    std::string_view digits = text.substr(minus ? 1 : 0);
    if (digits.starts_with('-') || digits.starts_with('+'))
        return {};
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    if (column.scalar == Scalar::int32 && !hexadecimal) {
        const auto number = number_in<std::int32_t>(text);
        return number ? std::optional(static_cast<std::uint32_t>(*number)) : std::nullopt;
    }
    if (column.scalar != Scalar::float32)
        return minus         ? std::nullopt
               : hexadecimal ? number_in<std::uint32_t>(digits.substr(2), 16)
                             : number_in<std::uint32_t>(digits);
    auto number = hexadecimal ? number_in<float>(digits.substr(2), std::chars_format::hex) : number_in<float>(digits);
    // The float nearest to what is closer to 0 than any.
    if (const auto tiny = number || hexadecimal ? std::nullopt : number_in<double>(digits); tiny && *tiny < 1e-37)
        number = static_cast<float>(*tiny);
    return number ? std::optional(std::bit_cast<std::uint32_t>(minus ? -*number : *number)) : std::nullopt;
}

std::string_view no_number(const TableColumn& column) {
    if (column.is_bool)
        return "no bool; right is 0 or 1, false or true";
    switch (column.scalar) {
    case Scalar::int32:
        return "no int; right is 7, -7 or 0x7";
    case Scalar::uint32:
        return "no uint; right is 7 or 0x7, to 4294967295";
    case Scalar::float32:
        break;
    }
    return "no float; right is 0.25, 0x1p-2, inf or nan";
}

namespace {

/// A line with values.
struct TableLine {
    std::size_t number = 0;
    std::vector<std::string_view> values;
};

std::vector<TableLine> lines_of(std::string_view text) {
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark))
        text.remove_prefix(byte_order_mark.size());
    std::vector<TableLine> all;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = without_spaces(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.starts_with('#'))
            continue;
        TableLine& made = all.emplace_back(TableLine{number, {}});
        for (bool more = true; more;) {
            const std::size_t comma = line.find(',');
            more = comma != std::string_view::npos;
            made.values.push_back(without_spaces(line.substr(0, comma)));
            line.remove_prefix(more ? comma + 1 : line.size());
        }
    }
    return all;
}

/// For each column where its components stand in a line; none of a column that is left out.
std::vector<std::vector<std::size_t>> places_of(const std::vector<TableColumn>& columns, const TableLine& heading,
                                                const std::string& file, const std::string& taker) {
    std::vector<std::string> known;
    for (const TableColumn& column : columns)
        for (int c = 0; c < column.components; ++c)
            known.push_back(component_name(column, c));
    const std::vector<std::string> given(heading.values.begin(), heading.values.end());
    const auto fail = [&](const std::string& what) {
        throw Error(fmt::format("{}:{}: {}", file, heading.number, what));
    };
    for (const std::string& name : given) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            fail(fmt::format("column {} is none of {}'s; right is {}{}", plain_line(name), taker,
                             fmt::join(known, ", "), did_you_mean(name, known)));
        if (std::count(given.begin(), given.end(), name) > 1)
            fail(fmt::format("column {} stands there twice", name));
    }
    std::vector<std::vector<std::size_t>> places;
    for (const TableColumn& column : columns) {
        std::vector<std::size_t>& found = places.emplace_back();
        std::string missing;
        for (int c = 0; c < column.components; ++c) {
            const auto at = std::find(given.begin(), given.end(), component_name(column, c));
            if (at != given.end())
                found.push_back(static_cast<std::size_t>(at - given.begin()));
            else if (missing.empty())
                missing = component_name(column, c);
        }
        if (!missing.empty() && !(found.empty() && column.optional))
            fail(fmt::format("column {} is missing; {} takes {}", missing, taker, fmt::join(known, ", ")));
    }
    return places;
}

void read_csv(const std::filesystem::path& path, const std::vector<TableColumn>& columns, const std::string& taker,
              NumberTable& table) {
    const OpenedFile opened(path, "table");
    if (opened.size() > most_bytes)
        throw Error(fmt::format("{}: more than {} MiB", table.file, most_bytes >> 20U));
    const std::string text = opened.text();
    const std::vector<TableLine> lines = lines_of(text);
    if (lines.size() < 2)
        throw Error(fmt::format("{}: it has no rows; right is a line of column names, and a line a row", table.file));
    const auto places = places_of(columns, lines.front(), table.file, taker);
    table.rows = lines.size() - 1;
    for (std::size_t l = 1; l < lines.size(); ++l) {
        const TableLine& line = lines[l];
        if (line.values.size() != lines.front().values.size())
            throw Error(fmt::format("{}:{}: {} for {}", table.file, line.number, counted(line.values.size(), "value"),
                                    counted(lines.front().values.size(), "column")));
        table.lines.push_back(line.number);
        for (std::size_t c = 0; c < places.size(); ++c)
            for (std::size_t k = 0; k < places[c].size(); ++k) {
                const std::string_view value = line.values[places[c][k]];
                const std::optional<std::uint32_t> bits = number_bits(value, columns[c]);
                if (!bits)
                    throw Error(fmt::format("{}:{}: column {}: '{}' is {}", table.file, line.number,
                                            component_name(columns[c], static_cast<int>(k)), plain_line(value),
                                            no_number(columns[c])));
                table.words[c].push_back(*bits);
            }
    }
}

std::uint32_t word_of(const JsonValue& value, const TableColumn& column) {
    if (value.is_text()) {
        const std::optional<std::uint32_t> bits = number_bits(value.text(), column);
        if (!bits)
            value.fail(fmt::format("'{}' is {}", value.label(), no_number(column)));
        return *bits;
    }
    if (column.is_bool)
        return value.is_truth() ? (value.truth() ? 1U : 0U) : static_cast<std::uint32_t>(value.integer(0, 1));
    if (column.scalar == Scalar::int32)
        return static_cast<std::uint32_t>(
            value.integer(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
    if (column.scalar == Scalar::uint32)
        return static_cast<std::uint32_t>(value.integer(0, std::numeric_limits<std::uint32_t>::max()));
    return std::bit_cast<std::uint32_t>(value.number());
}

void read_json_table(const std::filesystem::path& path, const std::vector<TableColumn>& columns, NumberTable& table) {
    const nlohmann::json document = read_json(path);
    const JsonValue all(document, table.file);
    std::vector<std::string_view> names;
    for (const TableColumn& column : columns)
        names.push_back(column.name);
    for (const JsonValue& row : all.items()) {
        row.check_keys(names);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const TableColumn& column = columns[c];
            const bool is_left_out = column.optional && !row.find(column.name);
            if (table.rows > 0 && is_left_out != table.words[c].empty())
                row.fail(fmt::format("{} is in some rows and not in others; right is all or none", column.name));
            if (is_left_out)
                continue;
            const JsonValue value = row.at(column.name);
            if (column.components == 1) {
                table.words[c].push_back(word_of(value, column));
                continue;
            }
            const std::vector<JsonValue> components = value.is_array() ? value.items() : std::vector<JsonValue>();
            if (components.size() != static_cast<std::size_t>(column.components))
                value.fail(fmt::format("{} is {}; right is an array of {} {}", column.name, vector_type(column),
                                       column.components, column.is_bool ? "truths" : "numbers"));
            for (const JsonValue& component : components)
                table.words[c].push_back(word_of(component, column));
        }
        ++table.rows;
    }
    if (table.rows == 0)
        all.fail("it has no rows; right is an array of objects, one a row");
}

} // namespace

NumberTable read_number_table(const std::filesystem::path& file, const std::vector<TableColumn>& columns,
                              const std::string& taker) {
    NumberTable table{.file = plain_line(file.string()),
                      .rows = 0,
                      .words = std::vector<std::vector<std::uint32_t>>(columns.size()),
                      .lines = {}};
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".json")
        read_json_table(file, columns, table);
    else
        read_csv(file, columns, taker, table);
    return table;
}

} // namespace lockstep
