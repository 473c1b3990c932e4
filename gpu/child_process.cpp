#include "gpu/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gpu/driver_call.hpp"
#include "gpu/syscall_fence.hpp"

namespace lockstep {
namespace {

constexpr rlim_t fenced_memory = rlim_t{1} << 30U; // bytes of data, besides what the process has
constexpr char gave = 'g', threw = 't';            // the first byte of an answer

template <class Resource> void limit(Resource resource, rlim_t value) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min(value, limits.rlim_max);
    setrlimit(resource, &limits);
}

/// Bytes of data in use.
rlim_t data_in_use() {
    unsigned long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1)
            pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

bool write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

[[noreturn]] void be_child(const ChildRules& rules, const std::function<std::string()>& work, int pipe_end) {
    std::set_new_handler(nullptr);
    const int answers =
        fcntl(pipe_end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); // a closed stream's number may be the pipe's
    limit(RLIMIT_CORE, 0);
    // Drivers print to the terminal what the Error says anyway.
    if (const int null = ::open("/dev/null", O_RDWR); null >= 0)
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            dup2(null, stream);
    if (rules.fenced) {
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 + rules.seconds));
        limit(RLIMIT_FSIZE, 0);
        limit(RLIMIT_DATA, data_in_use() + fenced_memory);
        put_up_fence(Fence::reading, answers); // where the kernel has none, the limits alone hold it
    }
    std::string answer(1, gave);
    try {
        answer += work();
    } catch (const std::bad_alloc&) {
        answer = fmt::format("{}{} needs too much memory", threw, rules.subject);
    } catch (const std::exception& error) {
        answer = std::string(1, threw) + error.what();
    }
    _exit(write_all(answers, answer) ? 0 : 1);
}

/// Everything that is written before the other end closes; nothing if it does not close in time.
std::optional<std::string> read_all(int file, std::chrono::seconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    std::string text;
    std::array<char, 4096> chunk{};
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        pollfd ready{file, POLLIN, 0};
        const int polled = poll(&ready, 1, static_cast<int>(std::max<long>(left.count(), 0)));
        if (polled == 0)
            return std::nullopt;
        const ssize_t count = polled < 0 ? polled : read(file, chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return text;
        text.append(chunk.data(), static_cast<std::size_t>(count));
    }
}

int ended(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

} // namespace

std::string in_child(const ChildRules& rules, const std::function<std::string()>& work) {
    const auto fail = [] { throw NoChildProcess(fmt::format("no process can be started: {}", std::strerror(errno))); };
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        fail();
    const pid_t child = fork();
    if (child == 0)
        be_child(rules, work, ends[1]);
    const int reason = errno;
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        errno = reason;
        fail();
    }
    // A fenced child waits for nothing, and its processor time is bounded: only one that gets no turn takes longer.
    constexpr int turns = 15;
    const int patience = rules.fenced ? turns * rules.seconds : rules.seconds;
    const std::optional<std::string> answer = read_all(ends[0], std::chrono::seconds(patience));
    close(ends[0]);
    if (!answer)
        kill(child, SIGKILL);
    const int status = ended(child);
    if (!answer && rules.fenced)
        throw ChildStarved(fmt::format("{} got no {} s of processor time in {} s: the machine is too busy",
                                       rules.subject, rules.seconds, patience));
    if (!answer)
        throw ChildFailed(fmt::format("{} did not answer within {} s", rules.subject, patience));
    if (rules.fenced && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw ChildFailed(fmt::format("{} needs more than {} s of processor time", rules.subject, rules.seconds));
    if (WIFSIGNALED(status))
        throw ChildFailed(fmt::format("{} crashed with signal {} ({})", rules.subject, WTERMSIG(status),
                                      strsignal(WTERMSIG(status))));
    if (answer->empty())
        throw ChildFailed(fmt::format("{} ended the process", rules.subject));
    if (answer->front() == threw)
        throw Error(answer->substr(1));
    return answer->substr(1);
}

std::string in_child_if_possible(const ChildRules& rules, const std::function<std::string()>& work) try {
    return in_child(rules, work);
} catch (const NoChildProcess&) {
    const DriverCall call(rules.subject);
    return work();
}

} // namespace lockstep
