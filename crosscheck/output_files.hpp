#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/atomic_file.hpp"

namespace lockstep {

/// The files a run leaves behind: all of them, or none. They are named before the run, which does not start when one
/// of them could not be written. Every function throws Error naming the path.
class OutputFiles {
  public:
    OutputFiles() = default;
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;
    ~OutputFiles();

    /// Proves that the file can be written.
    void expect(const std::filesystem::path& file);

    /// Proves that files can be written to the folder; makes it if need be.
    void expect_folder(const std::filesystem::path& folder);

    /// The content of a file, expected or in an expected folder.
    void write(const std::filesystem::path& file, std::string content);

    /// Gives all files that were written their names.
    void commit();

  private:
    std::vector<std::filesystem::path> expected_;
    std::vector<AtomicFile> files_;                  ///< written, without their names
    std::vector<std::filesystem::path> new_folders_; ///< made here, outermost first; emptied by commit
};

} // namespace lockstep
