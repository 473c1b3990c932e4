#include "crosscheck/check_file/start_values.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/check_file/value_words.hpp"
#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/half.hpp"
#include "reference/model/near_name.hpp"
#include "reference/model/random.hpp"

namespace lockstep::check_file {
namespace {

std::vector<std::uint32_t> read_words(const JsonValue& value, const Field& field) {
    if (field.components == 1 && !value.is_array())
        return {read_word(value, field.scalar)};
    const std::vector<JsonValue> items = value.items();
    if (items.size() != static_cast<std::size_t>(field.components))
        value.fail(fmt::format("{} numbers; expected {}, for {} {}", items.size(), field.components, glsl_type(field),
                               field.name));
    std::vector<std::uint32_t> words;
    for (const JsonValue& item : items)
        words.push_back(read_word(item, field.scalar));
    return words;
}

/// A component's word by item.
using ItemWords = std::function<std::uint32_t(std::size_t item, std::size_t component)>;

struct Range {
    double first = 0.0, second = 0.0;
};

/// Two numbers that the field's components hold.
Range read_range(const JsonValue& value, const Field& field) {
    const std::vector<JsonValue> ends = value.items();
    if (ends.size() != 2)
        value.fail(fmt::format("{} numbers; expected 2", ends.size()));
    const auto number = [&](const JsonValue& one) {
        return field.scalar == Scalar::float32
                   ? double{one.number()}
                   : static_cast<double>(
                         one.integer(field.scalar == Scalar::int32 ? std::numeric_limits<std::int32_t>::min() : 0,
                                     std::numeric_limits<std::int32_t>::max()));
    };
    return {number(ends[0]), number(ends[1])};
}

ItemWords read_source(const JsonValue& value, const Field& field, std::size_t count) {
    if (!value.is_object()) {
        const std::vector<std::uint32_t> words = read_words(value, field);
        return [words](std::size_t, std::size_t c) { return words[c]; };
    }
    if (const auto values = value.find("values")) {
        value.check_keys({"values"});
        const std::vector<JsonValue> items = values->items();
        if (items.size() != count)
            values->fail(fmt::format("{} values; expected {}, one an item", items.size(), count));
        std::vector<std::uint32_t> words;
        for (const JsonValue& item : items) {
            const std::vector<std::uint32_t> one = read_words(item, field);
            words.insert(words.end(), one.begin(), one.end());
        }
        return [words, n = static_cast<std::size_t>(field.components)](std::size_t item, std::size_t c) {
            return words[item * n + c];
        };
    }
    if (const auto range = value.find("random")) {
        value.check_keys({"random", "seed"});
        const auto seed = value.find("seed");
        const auto of = static_cast<std::uint64_t>(seed ? seed->integer(0, 0xffffffff) : 1);
        const Range ends = read_range(*range, field);
        return [of, ends, scalar = field.scalar](std::size_t item, std::size_t c) {
            lockstep::Random random(of + c, item);
            return word_of(ends.first + (ends.second - ends.first) * random.unit(), scalar);
        };
    }
    if (const auto range = value.find("index")) {
        value.check_keys({"index"});
        const Range line = read_range(*range, field);
        return [line, scalar = field.scalar](std::size_t item, std::size_t) {
            return word_of(line.first + line.second * static_cast<double>(item), scalar);
        };
    }
    value.fail("is no start value; expected a number, a list of a component each, or one of values, random and index");
}

void set_field(const WritableView& state, std::size_t f, const ItemWords& words) {
    const auto n = static_cast<std::size_t>(state.fields()[f].components);
    for (std::size_t item = 0; item < state.count(); ++item)
        for (std::size_t c = 0; c < n; ++c) {
            const std::uint32_t word = words(item, c);
            std::memcpy(state.columns[f] + (item * n + c) * sizeof word, &word, sizeof word);
        }
}

void set_by_table(const JsonValue& start, const WritableView& state) {
    start.check_keys({"table"});
    std::vector<TableColumn> columns;
    for (const Field& field : state.fields())
        columns.push_back({.name = field.name, .scalar = field.scalar, .components = field.components});
    const JsonValue named = start.at("table");
    const NumberTable table = read_number_table(std::filesystem::path(start.file()).parent_path() / named.text(),
                                                columns, state.about().name);
    if (table.rows != state.count())
        named.fail(
            fmt::format("{} has {} rows; expected {}, one an item", plain_line(table.file), table.rows, state.count()));
    for (std::size_t f = 0; f < columns.size(); ++f)
        set_field(state, f, [&, n = static_cast<std::size_t>(columns[f].components)](std::size_t item, std::size_t c) {
            return table.words[f][item * n + c];
        });
}

/// What an image of halves holds.
void round_to_halves(const WritableView& state) {
    const std::size_t words = state.count() * static_cast<std::size_t>(state.fields().front().components);
    for (std::size_t w = 0; w < words; ++w) {
        float number = 0.0F;
        std::memcpy(&number, state.columns[0] + w * sizeof number, sizeof number);
        number = half_nearest(number);
        std::memcpy(state.columns[0] + w * sizeof number, &number, sizeof number);
    }
}

/// Whether an object is a value, and not one by field.
bool is_source(const JsonValue& start) { return start.find("values") || start.find("random") || start.find("index"); }

} // namespace

namespace {

void set_values(const StateEntry& entry, const WritableView& state) {
    const JsonValue& start = *entry.start;
    const std::vector<Field>& fields = state.fields();
    if (start.is_object() && start.find("table"))
        return set_by_table(start, state);
    if (!start.is_object() || is_source(start)) {
        if (fields.size() != 1)
            start.fail(
                fmt::format("is one value, but an item has {} fields; expected an object by field", fields.size()));
        return set_field(state, 0, read_source(start, fields.front(), state.count()));
    }
    // Where two buffers have fields of one name, the buffer's goes before it.
    const std::string before = entry.name + "_";
    std::vector<std::string> names;
    for (const Field& field : fields)
        names.push_back(field.name.starts_with(before) ? field.name.substr(before.size()) : field.name);
    for (const std::string& name : start.keys()) {
        auto found = std::ranges::find(names, name);
        if (found == names.end() && name.starts_with(before))
            found = std::ranges::find(names, name.substr(before.size()));
        if (found == names.end())
            start.at(name).fail(fmt::format("its shaders declare no field {}; they have {}{}", plain_line(name),
                                            fmt::join(names, ", "), did_you_mean(name, names)));
        const auto f = static_cast<std::size_t>(found - names.begin());
        set_field(state, f, read_source(start.at(name), fields[f], state.count()));
    }
}

} // namespace

void set_start(const StateEntry& entry, const WritableView& state) {
    if (entry.start)
        set_values(entry, state);
    if (entry.format.ends_with("16f"))
        round_to_halves(state);
}

} // namespace lockstep::check_file
