#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace lockstep {

/// Throws Error: what is wrong with a mesh file, behind its name.
[[noreturn]] void fail_on(const std::filesystem::path& file, std::string_view what);

/// The number of faces that a PLY file's header declares, after its body was found to hold every element that is
/// declared: Assimp fills up what a file lacks, or leaves it out. Throws Error naming the file.
std::size_t ply_faces(const std::string& ply, const std::filesystem::path& file);

} // namespace lockstep
