#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace lockstep {

/// Every reader of crosscheck/ notes what it reads; run_inputs.hpp puts that beside the shaders.

/// A file that was read, whole. Read again, it keeps the digest of the first time.
void note_read(const std::filesystem::path& file, std::string_view bytes);

/// A file that was opened, to be read in parts.
void note_opened(const std::filesystem::path& file);

/// SHA-256 of all of these so far; empty: opened alone.
std::map<std::filesystem::path, std::string> noted_files();

} // namespace lockstep
