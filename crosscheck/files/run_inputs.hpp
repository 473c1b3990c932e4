#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lockstep {

/// What the program read so far: the one list that says what its results rest on, of the readers of crosscheck/
/// (read_files.hpp) and of the shaders (gpu/shaders_read_once.hpp).

/// SHA-256 by name; empty: a shader file that was looked for and is absent. Without files that were opened alone. The
/// name of a file that comes with lockstep is its place in the data folder, the same on every machine.
using InputDigests = std::map<std::string, std::string>;
InputDigests input_digests();

/// The first file in which two runs differ: "m/a.vert is 0123456789ab..., there it is absent"; empty: none.
std::string input_difference(const InputDigests& one, const InputDigests& other);

/// Those that are there, as JSON: SHA-256 by name.
nlohmann::json inputs_json(const InputDigests& inputs);

/// "23 files, SHA-256 of their list 0123...": the same where every input is.
std::string inputs_text(const InputDigests& inputs);

/// Every file that is there and was read or opened.
std::vector<std::filesystem::path> files_read();

} // namespace lockstep
