#include <catch2/catch.hpp>

#include <cerrno>
#include <cstdio>
#include <functional>
#include <string>

#include <csignal>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gpu/syscall_fence.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::syscall_fence_test {

namespace {

/// What became of an attempt in a process behind that fence: 0 it was let through, else errno.
int tried(Fence fence, int writable, const std::function<long()>& attempt) {
    const pid_t child = fork();
    if (child == 0) {
        if (!put_up_fence(Fence::opening, writable).empty())
            _exit(250);
        if (fence == Fence::reading && !put_up_fence(Fence::reading, writable).empty())
            _exit(251);
        errno = 0;
        _exit(attempt() < 0 ? errno : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

} // namespace

TEST_CASE("syscall fence: nothing is started, written, removed, sent or made executable") {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("file", "text").string(), other = (folder.path() / "other").string();
    int ends[2] = {};
    REQUIRE(pipe(ends) == 0);
    const int opened = open(file.c_str(), O_RDWR);
    char byte = 0;
    for (const Fence fence : {Fence::opening, Fence::reading}) {
        CAPTURE(static_cast<int>(fence));
        const auto refused = [&](const std::function<long()>& attempt) {
            return tried(fence, ends[1], attempt) == EPERM;
        };
        CHECK(refused([] { return execl("/bin/true", "true", nullptr); }));
        CHECK(refused([] { return fork(); }));
        CHECK(refused([&] { return unlink(file.c_str()); }));
        CHECK(refused([&] { return std::rename(file.c_str(), other.c_str()); }));
        CHECK(refused([&] { return link(file.c_str(), other.c_str()); }));
        CHECK(refused([&] { return chmod(file.c_str(), 0777); }));
        CHECK(refused([&] { return truncate(file.c_str(), 0); }));
        CHECK(refused([&] { return open(file.c_str(), O_WRONLY); }));
        CHECK(refused([&] { return open(other.c_str(), O_RDONLY | O_CREAT, 0600); }));
        CHECK(refused([&] { return ftruncate(opened, 0); }));
        CHECK(refused([&] { return write(opened, "x", 1); }));
        CHECK(refused([] { return socket(AF_INET, SOCK_STREAM, 0); }));
        CHECK(refused([] { return kill(getppid(), 0); }));
        CHECK(refused([] {
            return mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1
                                                                                                                : 0;
        }));
        CHECK(tried(fence, ends[1], [&] { return write(ends[1], "x", 1); }) == 0);
        CHECK(tried(fence, ends[1], [&] { return pread(opened, &byte, 1, 0); }) == 0);
    }
    CHECK(tried(Fence::opening, ends[1], [&] { return open(file.c_str(), O_RDONLY); }) == 0);
    CHECK(tried(Fence::reading, ends[1], [&] { return open(file.c_str(), O_RDONLY); }) == EPERM);
    for (const int descriptor : {opened, ends[0], ends[1]})
        close(descriptor);
}

} // namespace lockstep::test::syscall_fence_test
