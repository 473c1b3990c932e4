#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Of a DIVERGENT run of collision with shaders of the user's, lines of theirs that have no counterpart in the shipped
/// ones, in the first frame that differs, or in the last one's picture. `rendered`: that is drawn, too.
std::vector<std::string> lines_without_counterpart(const Scene& scene, const std::filesystem::path& shaders,
                                                   const Profile& profile, const KnownOperations& known,
                                                   const CheckReport& report, bool rendered);

} // namespace lockstep
