#include "crosscheck/record/reading_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gpu/syscall_fence.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using Started = ReadingProcess::Started;

constexpr std::size_t opening_memory = std::size_t{1} << 30U; // bytes, to look at a file and read its small parts
constexpr rlim_t seconds_a_request = 60;                      // of processor time
constexpr int patience = 120'000;                             // milliseconds without a byte

/// What it means that the reading process ended of a signal; 0: of none.
std::string end_text(int signal) {
    switch (signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGABRT:
    case SIGFPE:
    case SIGILL:
    case SIGSYS:
        return fmt::format("HDF5 broke on it ({}): the file is not what its seal says, or was made to do harm",
                           strsignal(signal));
    case SIGXCPU:
        return "reading one state of it took over a minute of processor time";
    case 0:
        return "the process that reads it ended early: the file is not what its seal says, or was made to do harm";
    case SIGKILL:
        return "the process that reads it was killed from outside (Killed), as systems do where memory runs out; try "
               "again";
    default:
        return fmt::format("the process that reads it was ended from outside ({}); try again", strsignal(signal));
    }
}

/// Bytes of address space in use.
std::size_t address_space() {
    std::size_t pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%zu", &pages) != 1)
            pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

template <class Resource> void limit(Resource resource, rlim_t value) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min(value, limits.rlim_max); // RLIM_INFINITY is the largest
    setrlimit(resource, &limits);
}

template <class Resource> void limit_for_good(Resource resource, rlim_t value) {
    const rlimit limits{value, value};
    setrlimit(resource, &limits);
}

/// So much processor time from now on.
void limit_time() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds_a_request);
}

/// The asking process's handlers are not to run here, and Ctrl-C is its alone.
void default_signals() {
    for (int signal = 1; signal < NSIG; ++signal)
        std::signal(signal, signal == SIGINT ? SIG_IGN : SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Descriptors of the reading process; nothing else that the asking process has open is open there.
constexpr int requests_from = 3, answers_to = 4, the_file = 5;

void keep_descriptors(int requests, int answers) {
    const int above = std::max({requests, answers, the_file}) + 1; // not to overwrite one with the other
    const int kept_requests = fcntl(requests, F_DUPFD, above);
    const int kept_answers = fcntl(answers, F_DUPFD, above);
    const int null = open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(null, standard);
    dup2(kept_requests, requests_from);
    dup2(kept_answers, answers_to);
    close_range(the_file, ~0U, 0);
}

/// What is left to a process that reads one file. `memory`: bytes of address space. Gives why the kernel puts up no
/// fence of its own, or an empty text.
std::string fence(std::size_t memory) {
    default_signals();
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    limit_for_good(RLIMIT_CORE, 0);
    limit_for_good(RLIMIT_FSIZE, 0);
    limit_for_good(RLIMIT_NPROC, 0);
    limit_for_good(RLIMIT_NOFILE, the_file + 1);
    limit(RLIMIT_AS, memory);
    limit_time();
    return put_up_fence(Fence::opening, answers_to);
}

void write_all(const void* bytes, std::size_t count) {
    const char* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(answers_to, at, count);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            _exit(0);
        at += written;
        count -= static_cast<std::size_t>(written);
    }
}

[[noreturn]] void read_file(const std::function<void(ReadingEnd&)>& work, int requests, int answers) {
    keep_descriptors(requests, answers);
    const std::size_t memory = address_space() + opening_memory;
    ReadingEnd end(memory, fence(memory));
    try {
        work(end);
    } catch (const std::bad_alloc&) {
        ReadingEnd::send(MessageKind::error, std::string("needs more memory than a trace of its size may"));
    } catch (const std::exception& error) {
        ReadingEnd::send(MessageKind::error, std::string(error.what()));
    }
    _exit(0);
}

Started start_process(const OpenedFile& file, const std::function<void(ReadingEnd&)>& work) {
    const auto fail = [&] {
        throw Error(
            fmt::format("{}: no process to read it can be started: {}", file.path().string(), std::strerror(errno)));
    };
    std::array<int, 2> requests{}, answers{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, requests.data()) != 0)
        fail();
    if (pipe2(answers.data(), O_CLOEXEC) != 0) {
        close(requests[0]);
        close(requests[1]);
        fail();
    }
    fcntl(answers[1], F_SETPIPE_SZ, 1 << 20);
    const pid_t pid = fork();
    if (pid == 0) {
        close(requests[0]);
        close(answers[0]);
        read_file(work, requests[1], answers[1]);
    }
    close(requests[1]);
    close(answers[1]);
    if (pid < 0) {
        close(requests[0]);
        close(answers[0]);
        fail();
    }
    return {pid, requests[0], answers[0]};
}

int end_process(Started& process, std::chrono::milliseconds grace) {
    if (process.pid < 0)
        return 0;
    close(std::exchange(process.requests, -1));
    close(std::exchange(process.answers, -1));
    const int pid = std::exchange(process.pid, -1);
    int status = 0;
    pid_t reaped = 0;
    for (const auto end = std::chrono::steady_clock::now() + grace;
         (reaped = waitpid(pid, &status, WNOHANG)) == 0 && std::chrono::steady_clock::now() < end;)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (reaped == pid)
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    return 0;
}

} // namespace

void ReadingEnd::put_up_fence() {
    if (unfenced_.empty())
        unfenced_ = lockstep::put_up_fence(Fence::reading, answers_to);
}

void ReadingEnd::allow(std::size_t bytes, std::vector<std::string>& warnings) const {
    if (!unfenced_.empty())
        warnings.push_back(fmt::format("the kernel puts up no seccomp filter ({}): the process that reads the trace is "
                                       "held by its limits alone",
                                       unfenced_));
    limit(RLIMIT_AS, memory_ + bytes);
}

void ReadingEnd::send(const MessageHead& head, const void* bytes) {
    write_all(&head, sizeof head);
    write_all(bytes, head.bytes);
}

bool ReadingEnd::next(Request& request) {
    if (recv(requests_from, &request, sizeof request, MSG_WAITALL) != sizeof request)
        return false;
    limit_time();
    return true;
}

ReadingProcess::ReadingProcess(const OpenedFile& file, const std::function<void(ReadingEnd&)>& work)
    : file_(file.path().string()), process_(start_process(file, work)) {}

ReadingProcess::~ReadingProcess() { end_process(process_, std::chrono::milliseconds(0)); }

void ReadingProcess::ask(MessageKind kind, int index, std::uint32_t resource) {
    const Request request{kind, static_cast<std::uint32_t>(index), resource};
    if (::send(process_.requests, &request, sizeof request, MSG_NOSIGNAL) != sizeof request)
        broke();
}

void ReadingProcess::read(void* into, std::size_t bytes) {
    char* at = static_cast<char*>(into);
    while (bytes > 0) {
        pollfd ready{process_.answers, POLLIN, 0};
        const int polled = poll(&ready, 1, patience);
        if (polled < 0 && errno == EINTR)
            continue;
        if (polled == 0)
            throw Error(fmt::format("{}: nothing could be read from it for {} s", file_, patience / 1000));
        const ssize_t got = ::read(process_.answers, at, bytes);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            broke();
        at += got;
        bytes -= static_cast<std::size_t>(got);
    }
}

void ReadingProcess::broke() {
    if (process_.pid >= 0)
        signal_ = end_process(process_, std::chrono::seconds(2));
    throw Error(fmt::format("{}: {}", file_, end_text(signal_)));
}

} // namespace lockstep
