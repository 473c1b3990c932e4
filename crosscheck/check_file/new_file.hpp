#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace lockstep::check_file {

/// The text of a check file for shaders of one folder, which run in this order: with what they declare, and numbers
/// that somebody may put right, each named in its list "todo". A block that is only read and another of the same
/// records that is only written, whose names differ by words as In and Out, are one buffer. Throws Error as
/// shader_text does, and for shaders of several folders.
std::string new_file(std::span<const std::filesystem::path> shaders);

} // namespace lockstep::check_file
