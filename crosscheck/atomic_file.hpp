#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace lockstep {

/// A file that is either whole or absent: the content goes to a temporary file beside it, which gets the name at
/// commit(), or goes away. What is no regular file (a device, a pipe, a symbolic link) is written to in place, at
/// commit(). Every function throws Error naming the path.
class AtomicFile {
  public:
    /// Proves that the file can be written, without a change to it.
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(AtomicFile&&) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    void write(std::string content);
    void commit();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::filesystem::path temporary_; ///< empty: there is none
    std::string content_;             ///< of what is written in place
    bool in_place_ = false;
};

/// One such file.
void write_text_file(const std::filesystem::path& path, std::string_view text);

} // namespace lockstep
