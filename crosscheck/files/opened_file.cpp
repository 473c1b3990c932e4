#include "crosscheck/files/opened_file.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "crosscheck/files/read_files.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
    throw Error(fmt::format("{}: {}", path.string(), what));
}

bool same_time(const timespec& a, const timespec& b) { return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec; }

} // namespace

OpenedFile::OpenedFile(const std::filesystem::path& path, std::string_view kind) : path_(path) {
    // Not blocking: a pipe that nobody writes would hold the program before it is found to be one.
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (descriptor_ < 0)
        fail(path, fmt::format("cannot be opened: {}", std::strerror(errno)));
    if (fstat(descriptor_, &opened_) == 0 && S_ISREG(opened_.st_mode)) {
        note_opened(path);
        return;
    }
    close(descriptor_);
    fail(path, fmt::format("{}, not a {}", S_ISDIR(opened_.st_mode) ? "a folder" : "a pipe or a device", kind));
}

OpenedFile::~OpenedFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

std::size_t OpenedFile::read(std::uint64_t offset, std::span<std::byte> into) const {
    std::size_t count = 0;
    while (count < into.size()) {
        const ssize_t got =
            pread(descriptor_, into.data() + count, into.size() - count, static_cast<off_t>(offset + count));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail(path_, fmt::format("cannot be read: {}", std::strerror(errno)));
        if (got == 0)
            break;
        count += static_cast<std::size_t>(got);
    }
    return count;
}

std::string OpenedFile::text() const {
    std::string text(size(), '\0');
    text.resize(read(0, std::as_writable_bytes(std::span(text))));
    note_read(path_, text);
    return text;
}

bool OpenedFile::is(int descriptor) const {
    struct stat other {};
    return fstat(descriptor, &other) == 0 && other.st_dev == opened_.st_dev && other.st_ino == opened_.st_ino;
}

void OpenedFile::expect_unchanged() const {
    struct stat now {};
    if (fstat(descriptor_, &now) != 0 || now.st_size != opened_.st_size || !same_time(now.st_mtim, opened_.st_mtim))
        fail(path_, "was written while it was read; what was read so far may be of two files");
}

} // namespace lockstep
