#pragma once
#include <filesystem>
#include <string_view>

namespace lockstep {

/// lockstep's own shaders: $LOCKSTEP_DATA/shaders, else those of the installation the program is in, else of the
/// package it was linked with (use_package_data), else of the source tree it was built from.
/// Throws Error if $LOCKSTEP_DATA has none, or there are none at all.
std::filesystem::path built_in_shaders();

/// A scene that comes with lockstep: "lattice", "x_streams", "catalogue/behind". Looked for as the shaders are.
/// Throws Error naming the folders if there is none of that name.
std::filesystem::path shipped_scene(std::string_view name);

/// Makes the folder of an installed package known, share/lockstep; true. <lockstep/lockstep.hpp> calls it.
bool use_package_data(const std::filesystem::path& folder);

/// That folder; empty: the program is linked with no installed package.
const std::filesystem::path& package_data_folder();

} // namespace lockstep
