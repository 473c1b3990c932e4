#pragma once
#include <filesystem>

#include <nlohmann/json.hpp>

namespace lockstep {

inline constexpr const char* study_results_name = "study.json";

/// What `lockstep study SCENE --json FOLDER/study.json` wrote, if it lies there; else null. Throws Error naming the
/// file if it is anything else.
nlohmann::json study_results(const std::filesystem::path& folder);

} // namespace lockstep
