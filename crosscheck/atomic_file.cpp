#include "crosscheck/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// Writes `file`; `path` is the one to complain about.
void write_whole(const fs::path& file, std::string_view content, const fs::path& path) {
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (stream == nullptr)
        fail(path, std::strerror(errno));
    const bool written =
        std::fwrite(content.data(), 1, content.size(), stream) == content.size() && std::fflush(stream) == 0;
    const int error = errno;
    if (std::fclose(stream) != 0 && written)
        fail(path, std::strerror(errno));
    if (!written)
        fail(path, std::strerror(error));
}

} // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    if (fs::is_directory(path_, error) || !path_.has_filename())
        fail(path_, "it names a folder");
    const fs::file_status status = fs::symlink_status(path_, error);
    in_place_ = fs::exists(status) && !fs::is_regular_file(status);
    if (!in_place_) {
        write({});
        fs::remove(std::exchange(temporary_, {}), error);
    }
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        fs::remove(temporary_, ignored);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})),
      content_(std::move(other.content_)), in_place_(other.in_place_) {}

void AtomicFile::write(std::string content) {
    if (in_place_) {
        content_ = std::move(content);
        return;
    }
    temporary_ = path_;
    temporary_ += fmt::format(".{}.part", getpid());
    write_whole(temporary_, content, path_);
}

void AtomicFile::commit() {
    if (in_place_)
        return write_whole(path_, content_, path_);
    std::error_code failed;
    fs::rename(temporary_, path_, failed);
    if (failed)
        fail(path_, failed.message());
    temporary_.clear();
}

void write_text_file(const fs::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(std::string(text));
    file.commit();
}

} // namespace lockstep
