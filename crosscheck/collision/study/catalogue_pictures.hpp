#pragma once
#include <filesystem>
#include <string_view>

#include "reference/model/image.hpp"

namespace lockstep {

/// An effect of the failure catalogue with its cause at work: what the viewer sees, and beside it the collision
/// camera's texels by what became of the searches there (study_picture). Throws Error as measure_catalogue does.
ColorImage catalogue_picture(std::string_view name, const std::filesystem::path& scenes);

} // namespace lockstep
