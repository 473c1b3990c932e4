#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/files/atomic_file.hpp"

namespace lockstep {

/// The files a run leaves behind: all of them, or none, and then what was there before. They are named before the run,
/// which does not start when one of them could not be written, is another output, or is an input. Every function throws
/// Error naming the path.
class OutputFiles {
  public:
    OutputFiles();
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// A file, or every file of a folder, that the run reads; none of them may be an output. Empty: nothing.
    void protect(const std::filesystem::path& input);

    /// Proves that the file can be written. A folder that is to be made comes first.
    void expect(const std::filesystem::path& file);

    /// Proves that files can be written to the folder, and those of these names; makes it if need be.
    void expect_folder(const std::filesystem::path& folder, std::span<const std::string_view> names = {});

    /// The content of a file, expected or in an expected folder.
    void write(const std::filesystem::path& file, std::string content);

    /// Gives all files that were written their names.
    void commit();

    /// "written   page/report.html, page/capsule.json\n": what commit gave a name; empty: nothing. Pipes and devices
    /// are left out.
    [[nodiscard]] std::string written_text() const;

    /// Whether the program has expected any file so far.
    static bool any_expected();

  private:
    AtomicFile& add(const std::filesystem::path& file);
    void make_folder(const std::filesystem::path& folder);

    std::map<FileIdentity, std::filesystem::path> inputs_;
    std::map<FileIdentity, std::filesystem::path> outputs_;
    std::vector<Temporary> new_folders_; ///< made here, outermost first; emptied by commit
    std::map<std::filesystem::path, AtomicFile> files_;
    std::vector<std::filesystem::path> written_; ///< in files_
    std::vector<std::filesystem::path> folders_; ///< expected
    std::vector<std::filesystem::path> named_;   ///< by commit
};

} // namespace lockstep
