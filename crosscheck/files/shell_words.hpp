#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace lockstep {

/// `word` as a shell takes it back to one word: quoted where it must be.
std::string shell_word(std::string_view word);

/// The same of a file's name, which is never taken for an option.
std::string shell_path(const std::filesystem::path& path);

} // namespace lockstep
