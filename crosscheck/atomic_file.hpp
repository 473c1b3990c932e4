#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace lockstep {

/// Writes a file so that it is either whole or absent: `write` gets the path of a temporary file beside it, which is
/// renamed when `write` returns and removed when it throws. Throws Error naming the path when that fails.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Creates a directory for output and proves that it can be written to. Throws Error saying why not.
void make_output_directory(const std::filesystem::path& directory);

} // namespace lockstep
