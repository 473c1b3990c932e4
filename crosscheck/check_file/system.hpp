#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "crosscheck/judge/registered_system.hpp"

/// Check files as a system that verbs run.
namespace lockstep::check_file {

inline constexpr std::string_view meaning = "passes over a state of one's own, as a check file has them";

/// As RegisteredSystem::load. Each pass leaves its state as it was until a text takes its place: --reference, or what
/// the file names.
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

/// As RegisteredSystem::folders: "shaders" and "reference", beside the file. The file's own folder where it names no
/// shaders; these where it names no reference.
SceneFolders folders_of(const JsonValue& document, const std::filesystem::path& file);

} // namespace lockstep::check_file
