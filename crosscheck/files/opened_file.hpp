#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <sys/stat.h>

namespace lockstep {

/// A file from elsewhere, opened once: what is checked and what is read are the same bytes, whatever becomes of its
/// name meanwhile. Only regular files, so that opening and reading end. Every function throws Error naming the path.
class OpenedFile {
  public:
    /// `kind`: what it is to be, for the error of a folder or a pipe ("trace").
    OpenedFile(const std::filesystem::path& path, std::string_view kind);
    ~OpenedFile();
    OpenedFile(OpenedFile&& other) noexcept
        : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), opened_(other.opened_) {}
    OpenedFile& operator=(OpenedFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t size() const { return static_cast<std::uint64_t>(opened_.st_size); } ///< when opened

    /// The bytes from `offset` on, as many as there are and fit; gives their number.
    std::size_t read(std::uint64_t offset, std::span<std::byte> into) const;
    /// All of it.
    [[nodiscard]] std::string text() const;

    /// Whether another descriptor is of this very file.
    [[nodiscard]] bool is(int descriptor) const;
    /// Throws if it was written since it was opened.
    void expect_unchanged() const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    struct stat opened_ {};
};

} // namespace lockstep
