#include "crosscheck/files/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/stat.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crosscheck/files/signals.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

constexpr mode_t permissions = 07777;

[[noreturn]] void fail_writing(const fs::path& path, const std::string& reason) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), reason));
}
[[noreturn]] void fail_writing(const fs::path& path) { fail_writing(path, std::strerror(errno)); }

/// Whether all of it was written; else errno says why not.
bool write_all(int file, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = write(file, content.data(), content.size());
        if (written < 0 && errno != EINTR)
            return false;
        content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    return true;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

/// The file that a symbolic link leads to, there or not; nothing else stands for itself.
fs::path behind_links(const fs::path& path) {
    constexpr int most_links = 40;
    fs::path target = path;
    std::error_code error;
    for (int link = 0; fs::is_symlink(fs::symlink_status(target, error)); ++link) {
        if (link == most_links)
            fail_writing(path, std::strerror(ELOOP));
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    return target;
}

/// A name that cannot be given to another file: mounted by itself, as containers do, or another user's in a folder like
/// /tmp.
bool keeps_its_name(const fs::path& path, const struct stat& file) {
    struct statx status {};
    if (statx(AT_FDCWD, path.c_str(), 0, 0, &status) == 0 && (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0)
        return true;
    struct stat folder {};
    const uid_t user = geteuid();
    return user != 0 && stat(folder_of(path).c_str(), &folder) == 0 && (folder.st_mode & S_ISVTX) != 0 &&
           file.st_uid != user && folder.st_uid != user;
}

bool same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

/// The standard stream that is this file; -1: none is.
int stream_of(const struct stat& status) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        if (struct stat other{}; fstat(stream, &other) == 0 && same_file(status, other))
            return stream;
    return -1;
}

bool is_name_of_stream(const fs::path& path) {
    const std::string& name = path.native();
    return name.starts_with("/dev/") || name.starts_with("/proc/");
}

} // namespace

FileIdentity identity_of(const fs::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0)
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    return {status.st_dev, status.st_ino, ""};
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
    if (path_ == "-")
        fail_writing(path_, "/dev/stdout is standard output, and ./- a file of that name");
    struct stat status {};
    const bool there = stat(path_.c_str(), &status) == 0;
    if (!there && errno != ENOENT)
        fail_writing(path_);
    if ((there && S_ISDIR(status.st_mode)) || !path_.has_filename())
        fail_writing(path_, "it names a folder");
    target_ = behind_links(path_);
    struct stat resolved {};
    const bool found = there && stat(target_.c_str(), &resolved) == 0 && same_file(status, resolved);
    in_place_ =
        there && (!S_ISREG(status.st_mode) || !found || stream_of(status) >= 0 || keeps_its_name(target_, status));
    if (in_place_)
        open_in_place();
    else if (there && access(target_.c_str(), W_OK) != 0)
        fail_writing(path_);
    else
        prove_temporary();
}

void AtomicFile::prove_temporary() {
    // One byte shows a full disk and a used up quota.
    const int proof = make_temporary();
    const bool written = write_all(proof, "\n");
    const int error = errno;
    if (close(proof) != 0)
        fail_writing(path_);
    if (!written)
        fail_writing(path_, std::strerror(error));
    temporary_ = {};
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)), target_(std::move(other.target_)), temporary_(std::move(other.temporary_)),
      before_(std::move(other.before_)), content_(std::move(other.content_)),
      descriptor_(std::exchange(other.descriptor_, -1)), in_place_(other.in_place_), committed_(other.committed_) {}

void AtomicFile::open_in_place() {
    struct stat status {};
    stat(path_.c_str(), &status);
    if (const int stream = stream_of(status); stream >= 0 && (S_ISREG(status.st_mode) || S_ISSOCK(status.st_mode))) {
        if (!is_name_of_stream(path_))
            fail_writing(path_, fmt::format("standard {} goes there", stream == STDOUT_FILENO ? "output" : "error"));
        descriptor_ = dup(stream);
        if (descriptor_ < 0)
            fail_writing(path_);
        return;
    }
    // Not to wait for a reader: not before there is something to read.
    descriptor_ = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENXIO && S_ISFIFO(status.st_mode))
        return;
    // A device that takes nothing (/dev/full) says so.
    if (descriptor_ < 0 || (S_ISCHR(status.st_mode) && ::write(descriptor_, "", 0) != 0))
        fail_writing(path_);
    fcntl(descriptor_, F_SETFL, 0);
}

int AtomicFile::make_temporary() {
    struct stat before {};
    const bool there = stat(target_.c_str(), &before) == 0;
    for (;;) {
        temporary_ = Temporary(temporary_name(target_));
        const int file = open(temporary_.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, there ? 0600 : 0666);
        if (file < 0 && errno == EEXIST) {
            temporary_.keep(); // another program's
            continue;
        }
        if (file < 0)
            fail_writing(path_);
        if (there) {
            const bool own = fchown(file, before.st_uid, before.st_gid) == 0 || before.st_uid == geteuid();
            fchmod(file, before.st_mode & (own ? permissions : mode_t{0777}));
        }
        return file;
    }
}

fs::path AtomicFile::make() {
    if (in_place_)
        fail_writing(path_, "it is no regular file");
    close(make_temporary());
    return temporary_.path();
}

void AtomicFile::write(std::string content) {
    if (in_place_) {
        content_ = std::move(content);
        return;
    }
    const int file = make_temporary();
    const bool written = write_all(file, content);
    const int error = errno;
    if (close(file) != 0 && written)
        fail_writing(path_);
    if (!written)
        fail_writing(path_, std::strerror(error));
}

void AtomicFile::commit() {
    if (in_place_) {
        std::fflush(stdout);
        if (descriptor_ < 0)
            descriptor_ = open(path_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
        struct stat status {};
        if (descriptor_ < 0 || fstat(descriptor_, &status) != 0 || !write_all(descriptor_, content_))
            fail_writing(path_);
        if (S_ISREG(status.st_mode) && stream_of(status) < 0 && ftruncate(descriptor_, std::ssize(content_)) != 0)
            fail_writing(path_);
        if (close(std::exchange(descriptor_, -1)) != 0)
            fail_writing(path_);
        return;
    }
    const SignalsWait wait;
    Temporary before(temporary_name(target_));
    if (link(target_.c_str(), before.path().c_str()) != 0)
        before.keep();
    if (rename(temporary_.path().c_str(), target_.c_str()) != 0)
        fail_writing(path_);
    temporary_.keep();
    before_ = std::move(before);
    committed_ = true;
}

void AtomicFile::undo() noexcept {
    if (!std::exchange(committed_, false))
        return;
    if (before_.empty())
        unlink(target_.c_str());
    else if (rename(before_.path().c_str(), target_.c_str()) == 0)
        before_.keep();
}

FileIdentity AtomicFile::identity() const {
    struct stat status {};
    if (stat(in_place_ ? path_.c_str() : target_.c_str(), &status) == 0)
        return {status.st_dev, status.st_ino, ""};
    FileIdentity identity = identity_of(folder_of(target_));
    identity.name = target_.filename();
    return identity;
}

void write_text_file(const fs::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(std::string(text));
    file.commit();
}

} // namespace lockstep
