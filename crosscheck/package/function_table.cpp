#include "lockstep/function_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/open_pass.hpp"
#include "crosscheck/package/function_signature.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/error.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep {
namespace {

namespace site {
constexpr Site expected{"expected"};
} // namespace site

LegalWord exact(const Value& whole) {
    const auto value = static_cast<double>(whole.integer());
    return {whole.bits, {value, value}};
}

bool is_subnormal(std::uint32_t word) { return (word & 0x7f800000U) == 0 && (word & 0x007fffffU) != 0; }

/// A float that a reading may take for 0, and this thread, too, while it flushes: a result of 0 is another.
LegalWord exact_subnormal(std::uint32_t word) {
    const double value = std::ldexp(static_cast<double>(word & 0x007fffffU), -149) * ((word >> 31U) != 0 ? -1.0 : 1.0);
    return {word, {value, value}};
}

/// Leaves the arguments as they are and returns the result that is expected of the row.
struct ExpectedResult {
    std::vector<function_twin::Column> columns; ///< the arguments', and last the result's
    std::vector<std::uint32_t> results;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> row;
        for (std::size_t f = 0; f + 1 < columns.size(); ++f)
            for (int c = 0; c < columns[f].components; ++c) {
                const FieldId field{0, static_cast<std::uint8_t>(f)};
                if (columns[f].scalar != Scalar::float32)
                    row.add(exact({columns[f].scalar, in.before.word(field, item, c)}));
                else
                    row.add(r.uniform(function_twin::site::argument, in.before.real(field, item, c)));
            }
        const auto components = static_cast<std::size_t>(columns.back().components);
        const std::uint32_t* const words = results.data() + item * components;
        const auto at = [&](std::size_t c) { return r.uniform(site::expected, std::bit_cast<float>(words[c])); };
        std::size_t added = 0;
        const auto add_one = [&](const auto& number) {
            const std::uint32_t word = words[added++];
            if (is_subnormal(word))
                row.add(exact_subnormal(word));
            else
                row.add(number);
        };
        const auto add = [&](const auto&... numbers) { (add_one(numbers), ...); };
        const At noted(function_twin::site::result, std::source_location()); // no line of the user's
        if (columns.back().scalar != Scalar::float32) {
            for (std::size_t c = 0; c < components; ++c)
                row.add(exact({columns.back().scalar, words[c]}));
        } else if (components == 1) {
            add(r.note(noted, typename R::Real(at(0))));
        } else if (components == 2) {
            const auto v = r.note(noted, typename R::Vec2{at(0), at(1)});
            add(v.x, v.y);
        } else if (components == 3) {
            const auto v = r.note(noted, typename R::Vec3{at(0), at(1), at(2)});
            add(v.x, v.y, v.z);
        } else {
            const auto v = r.note(noted, typename R::Vec4{at(0), at(1), at(2), at(3)});
            add(v.x, v.y, v.z, v.w);
        }
        return row;
    }
};

/// A function's own text, and its arguments as they are.
class OwnResults final : public OwnText {
  public:
    OwnResults(std::size_t columns, OpenResults results) : columns_(columns), results_(std::move(results)) {}
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& /*profile*/,
                                                    const KnownOperations& known) const override {
        return with_arguments(in, item, results_(item, {.in_any_order = !known.sums}));
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes_as_written(const PassInput& in, std::size_t item,
                                                               const Profile& /*profile*/,
                                                               const KnownOperations& known) const override {
        return with_arguments(in, item, results_(item, {.as_written = true, .in_any_order = !known.sums}));
    }

  private:
    [[nodiscard]] std::vector<ItemOutcome> with_arguments(const PassInput& in, std::size_t item,
                                                          std::vector<ItemOutcome> all) const {
        std::vector<Interval> arguments;
        const View rows = in.before[0];
        for (std::uint8_t f = 0; f < columns_; ++f)
            for (int c = 0; c < rows.fields()[f].components; ++c) {
                const Value value = rows.value(f, item, c);
                arguments.push_back(item_twin::set_of(value.bits, value.scalar));
            }
        for (ItemOutcome& one : all)
            one.values.insert(one.values.begin(), arguments.begin(), arguments.end());
        return all;
    }

    std::size_t columns_; ///< the arguments'
    OpenResults results_;
};

std::vector<function_twin::Column> all_columns(const Schema& schema) {
    std::vector<function_twin::Column> columns;
    for (const Field& field : schema.resources.front().fields)
        columns.push_back({field.scalar, field.components});
    return columns;
}

std::size_t words_of(const std::vector<function_twin::Column>& columns) {
    std::size_t words = 0;
    for (const function_twin::Column& column : columns)
        words += static_cast<std::size_t>(column.components);
    return words;
}

void set_bits(SystemState& state, FieldId field, std::size_t row, int component, std::uint32_t bits) {
    if (state.schema()[field].scalar == Scalar::float32)
        state.set(field, row, std::bit_cast<float>(bits), component);
    else
        state.set(field, row, bits, component);
}

SystemState start_of(const Schema& schema, const FunctionRows& rows) {
    SystemState start(schema, {{rows.count()}});
    std::size_t next = 0;
    for (std::size_t row = 0; row < rows.count(); ++row)
        for (std::size_t f = 0; f < rows.columns.size(); ++f)
            for (int c = 0; c < rows.columns[f].components; ++c)
                set_bits(start, {0, static_cast<std::uint8_t>(f)}, row, c, rows.words[next++]);
    return start;
}

/// A function as the system of its one pass, on a table.
System system_of(const GlslFunction& function, const function_twin::Called& called, const FunctionRows& rows,
                 ExpectedResults expected) {
    System system{.name = function.name,
                  .schema = called.schema,
                  .passes = {},
                  .mistakes = {},
                  .start = start_of(called.schema, rows),
                  .settings = {}};
    // A result that was not written is none that is right.
    const FieldId result{0, static_cast<std::uint8_t>(rows.columns.size())};
    const auto components = static_cast<std::size_t>(called.schema[result].components);
    for (std::size_t word = 0; word < expected.words.size(); ++word)
        set_bits(system.start, result, word / components, static_cast<int>(word % components), ~expected.words[word]);
    system.passes.push_back(item_pass({.name = std::string(function_twin::pass_name)},
                                      ExpectedResult{all_columns(called.schema), std::move(expected.words)}));
    for (OpenResults* open : {&expected.expected, &expected.own})
        if (*open)
            system.passes.back() = open_pass(std::move(system.passes.back()),
                                             std::make_shared<OwnResults>(rows.columns.size(), std::move(*open)));
    system.settings = std::move(expected.from);
    return system;
}

/// Whether two functions are one.
bool is_same(const GlslFunction& a, const GlslFunction& b) {
    return a.name == b.name && a.uniforms == b.uniforms && a.defines == b.defines &&
           function_twin::whole_text(a).text == function_twin::whole_text(b).text;
}

/// "row 7 (walls.csv:9): velocity (1, -2, 0), n (0, 1, 0)"
std::string row_text(const FunctionRows& rows, std::size_t row) {
    std::string text = fmt::format("row {}", row);
    if (row < rows.lines.size())
        text += fmt::format(" ({}:{})", rows.file, rows.lines[row]);
    const std::uint32_t* word = rows.words.data() + row * rows.width();
    for (std::size_t f = 0; f < rows.columns.size(); ++f) {
        std::string values;
        for (int c = 0; c < rows.columns[f].components; ++c, ++word)
            values += fmt::format("{}{}", c == 0 ? "" : ", ", decimal_text(Value{rows.columns[f].scalar, *word}));
        text += fmt::format("{} {} {}", f == 0 ? ":" : ",", rows.names[f],
                            rows.columns[f].components == 1 ? values : fmt::format("({})", values));
    }
    return text;
}

} // namespace

MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           ExpectedResults expected, const FunctionMatchOptions& options) {
    const function_twin::Called called = function_twin::called(function, rows.columns);
    constexpr std::size_t most = ItemWords<Values<PlainArithmetic>>::most;
    if (words_of(all_columns(called.schema)) > most)
        throw Error(fmt::format("{}: {} takes and returns more than {} numbers", plain_line(function.file),
                                function.name, most));
    const System system = system_of(function, called, rows, std::move(expected));
    const MatchResult result = function_twin::match_rows(gl, called, system, options);
    RunDescription about = result.run();
    about.scene = fmt::format("{} ({}, {})", function.name, plain_line(function.file), rows.file);
    if (const auto& verdicts = result.report().verdicts; verdicts && verdicts->first)
        about.notes.push_back("first: " + row_text(rows, verdicts->first->place.index));
    return {result.report(), std::move(about), result.passed()};
}

MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           const FunctionMatchOptions& options) {
    if (!rows.results)
        throw Error(fmt::format("{}: no column result, so nothing is expected of {}", rows.file, function.name));
    return match_function(gl, function, rows, ExpectedResults{*rows.results, "results of the table"}, options);
}

std::vector<std::uint32_t> returned(const Gl& gl, const GlslFunction& function, const FunctionRows& rows) {
    const function_twin::Called called = function_twin::called(function, rows.columns);
    const System system = system_of(function, called, rows, {{}, {}});
    SystemState after = system.start;
    function_twin::with_advice([&] {
        GlSystemSide gpu(gl, system, called.passes, called.folder);
        gpu.upload(system.start.view());
        gpu.step(0, 0);
        gpu.read(after);
    });
    const FieldId result{0, static_cast<std::uint8_t>(rows.columns.size())};
    std::vector<std::uint32_t> words;
    const SystemView view = after.view();
    for (std::size_t row = 0; row < rows.count(); ++row)
        for (int c = 0; c < called.schema[result].components; ++c)
            words.push_back(view.word(result, row, c));
    return words;
}

void check_comparable(const GlslFunction& function, const GlslFunction& like, const FunctionRows& rows) {
    if (is_same(function, like))
        throw Error(fmt::format("function: {} of {} is compared with itself: {} has the same text; expected another "
                                "function",
                                function.name, plain_line(function.file), plain_line(like.file)));
    const function_twin::Called one = function_twin::called(function, rows.columns);
    const function_twin::Called other = function_twin::called(like, rows.columns);
    const Field& wanted = one.schema.resources.front().fields.back();
    const Field& given = other.schema.resources.front().fields.back();
    if (wanted.scalar != given.scalar || wanted.components != given.components)
        throw Error(fmt::format("{}: {} returns another type than {} of {}", plain_line(like.file), like.name,
                                function.name, plain_line(function.file)));
}

std::string results_of(const GlslFunction& like) {
    return fmt::format("results of {} ({})", like.name, plain_line(like.file));
}

MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           const GlslFunction& like, const FunctionMatchOptions& options) {
    check_comparable(function, like, rows);
    return match_function(gl, function, rows, ExpectedResults{returned(gl, like, rows), results_of(like)}, options);
}

} // namespace lockstep
