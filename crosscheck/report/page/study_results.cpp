#include "crosscheck/report/page/study_results.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

/// Numbers, or null where there is nothing to count.
bool is_row(const json& row) {
    return row.is_object() && row.contains("recall") && row.contains("pairs") &&
           std::all_of(row.begin(), row.end(), [](const json& value) { return value.is_number() || value.is_null(); });
}

bool is_study(const json& study) {
    return study.is_object() && study.contains("total") && is_row(study.at("total")) && study.contains("frames") &&
           study.at("frames").is_array() && !study.at("frames").empty() &&
           std::all_of(study.at("frames").begin(), study.at("frames").end(),
                       [](const json& row) { return is_row(row) && row.contains("frame"); }) &&
           study.value("scene", json()).is_string() && study.value("repeat", json()).is_string();
}

} // namespace

json study_results(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / study_results_name;
    std::error_code none;
    if (!std::filesystem::exists(file, none))
        return nullptr;
    json study;
    try {
        study = read_json(file);
    } catch (const Error&) { // null is no study
    }
    if (!is_study(study))
        throw Error(fmt::format("{}: is not what `lockstep study SCENE --json` writes; write it again, or remove it",
                                file.string()));
    return study;
}

} // namespace lockstep
