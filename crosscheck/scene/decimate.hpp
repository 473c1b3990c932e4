#pragma once
#include <cstddef>
#include <filesystem>

#include "crosscheck/scene/surface.hpp"

namespace lockstep {

/// The surface reduced to `faces` triangles by quadric edge collapse (meshoptimizer), without unused vertices; as near
/// to the number as the collapses come. A surface that has no more faces than that keeps them all.
Surface decimate(const Surface& surface, std::size_t faces);

/// Writes positions (rounded to float) and triangles as OBJ, to a temporary name first. Throws Error.
void write_obj(const Surface& surface, const std::filesystem::path& file);

} // namespace lockstep
