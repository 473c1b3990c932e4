#include "crosscheck/report/page/rows_json.hpp"

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/report/value_text.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

json cell_json(const Cell& cell) {
    if (cell.empty())
        return nullptr;
    json out = cell.number ? number_json(*cell.number) : json::object();
    if (!cell.text.empty())
        out["text"] = cell.text;
    return out;
}

json row_json(const StepRow& row) {
    json out{{"label", row.label},
             {"strict", cell_json(row.strict)},
             {"reference", cell_json(row.reference)},
             {"gpu", cell_json(row.gpu)},
             {"verdict", row_verdict_names[static_cast<std::size_t>(row.verdict)]}};
    if (row.reference.number && row.gpu.number)
        out["ulp"] = row.ulp() == INT64_MAX ? json() : json(row.ulp());
    if (!row.reason.empty())
        out["reason"] = row.reason;
    if (!row.where.empty())
        out["where"] = row.where;
    return out;
}

} // namespace

json number_json(Value value) {
    const std::string number =
        value.scalar == Scalar::float32 ? fmt::format("{:.9g}", value.real()) : std::to_string(value.integer());
    return {{"value", number}, {"hex", exact_text(value)}};
}

json rows_json(const std::vector<StepRow>& rows) {
    json out = json::array();
    for (const StepRow& row : rows)
        out.push_back(row_json(row));
    return out;
}

} // namespace lockstep
