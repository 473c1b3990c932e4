#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include <sys/types.h>

#include "crosscheck/files/temporary.hpp"

namespace lockstep {

/// A file whatever its name: the same through links and by other ways to its folder.
struct FileIdentity {
    dev_t device = 0;
    ino_t inode = 0;  ///< of the file; of its folder where it is not there yet
    std::string name; ///< in that folder; else empty
    auto operator<=>(const FileIdentity&) const = default;
};

/// A file that is either whole or as it was: the content goes to a temporary file beside it, which gets the name at
/// commit(), or goes away. Through a symbolic link the file behind it is written; one that was there keeps its mode.
/// What is no regular file (a device, a pipe) is opened at once and written to in place, at commit().
/// Every function throws Error naming the path.
class AtomicFile {
  public:
    /// Proves that the file can be written, without a change to it.
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(AtomicFile&&) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    void write(std::string content);

    /// Instead of write: a new file, which the caller fills. Only of a regular file.
    std::filesystem::path make();

    void commit();

    /// After commit: the file is as it was before. Nothing in place can be undone.
    void undo() noexcept;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] FileIdentity identity() const;
    [[nodiscard]] bool in_place() const { return in_place_; }

  private:
    void open_in_place();
    void prove_temporary();
    int make_temporary();

    std::filesystem::path path_;
    std::filesystem::path target_; ///< behind links
    Temporary temporary_;          ///< empty: there is none
    Temporary before_;             ///< the file that was there, between commit and the end
    std::string content_;          ///< of what is written in place
    int descriptor_ = -1;          ///< in place; -1: a FIFO that nobody reads yet
    bool in_place_ = false;
    bool committed_ = false;
};

/// The identity of a file that is there; throws Error naming it if it is not.
FileIdentity identity_of(const std::filesystem::path& file);

/// One such file.
void write_text_file(const std::filesystem::path& path, std::string_view text);

} // namespace lockstep
