#include <fmt/format.h>

#include "crosscheck/files/number_table.hpp"
#include "crosscheck/package/function_signature.hpp"
#include "gpu/shader_source.hpp"
#include "lockstep/function_table.hpp"

namespace lockstep {
namespace {

constexpr std::string_view result_name = "result";

/// A table's columns: the arguments', and last the result's.
std::vector<TableColumn> columns_of(const GlslFunction& function, const function_twin::Signature& signature) {
    std::vector<TableColumn> columns;
    for (const function_twin::Parameter& parameter : signature.parameters) {
        const std::size_t number = columns.size() + 1;
        const std::optional<function_twin::Column> column = function_twin::column_of(parameter.type);
        if (!column)
            fail(function, signature, fmt::format("argument {} must be {}", number, function_twin::column_types));
        if (parameter.name == result_name)
            fail(function, signature, "an argument is called result, as the column of what it is to return");
        columns.push_back({parameter.name.empty() ? fmt::format("argument_{}", number) : parameter.name, column->scalar,
                           column->components, false, column->is_bool});
    }
    if (columns.empty())
        fail(function, signature, "it has no arguments, so there is nothing to make a table of");
    const std::optional<function_twin::Column> result = function_twin::column_of(signature.result);
    if (!result)
        fail(function, signature, fmt::format("its result must be {}", function_twin::column_types));
    columns.push_back({std::string(result_name), result->scalar, result->components, true, result->is_bool});
    return columns;
}

} // namespace

std::size_t FunctionRows::width() const {
    std::size_t all = 0;
    for (const function_twin::Column& column : columns)
        all += static_cast<std::size_t>(column.components);
    return all;
}

FunctionRows read_function_rows(const GlslFunction& function, const std::filesystem::path& file) {
    const function_twin::Signature signature = function_twin::signature_of(function);
    std::vector<TableColumn> columns = columns_of(function, signature);
    NumberTable table = read_number_table(file, columns, function_twin::shown(function.name, signature));
    FunctionRows rows{
        .file = table.file, .columns = {}, .names = {}, .words = {}, .lines = std::move(table.lines), .results = {}};
    if (!table.words.back().empty())
        rows.results = std::move(table.words.back());
    columns.pop_back();
    for (const TableColumn& column : columns) {
        rows.columns.push_back({column.scalar, column.components, column.is_bool});
        rows.names.push_back(column.name);
    }
    for (std::size_t row = 0; row < table.rows; ++row)
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto size = static_cast<std::ptrdiff_t>(columns[c].components);
            const auto first = table.words[c].begin() + static_cast<std::ptrdiff_t>(row) * size;
            rows.words.insert(rows.words.end(), first, first + size);
        }
    return rows;
}

} // namespace lockstep
