#include "crosscheck/report/gnuplot.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reference/model/error.hpp"

extern char** environ;

namespace lockstep {
namespace {

/// Both ends of a pipe that no other program gets.
struct Pipe {
    Pipe() {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Error("chart: no pipe to gnuplot can be made");
    }
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    void close_end(std::size_t end) {
        if (ends[end] >= 0)
            close(ends[end]);
        ends[end] = -1;
    }
    std::array<int, 2> ends{-1, -1};
};

/// What gnuplot says of a chart, kept in memory: a warning is none of the reader's business, a failure is.
class Messages {
  public:
    Messages() : file_(memfd_create("gnuplot", MFD_CLOEXEC)) {
        if (file_ < 0)
            throw Error("chart: no memory for gnuplot's messages");
    }
    ~Messages() { close(file_); }
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;

    [[nodiscard]] int file() const { return file_; }
    /// ": " and their beginning, as one line; empty: there are none.
    [[nodiscard]] std::string line() const {
        std::array<char, 300> start{};
        const ssize_t got = pread(file_, start.data(), start.size(), 0);
        std::istringstream words(std::string(start.data(), static_cast<std::size_t>(got > 0 ? got : 0)));
        std::string line;
        for (std::string word; words >> word;)
            line += (line.empty() ? ": " : " ") + word;
        return line;
    }

  private:
    int file_;
};

/// The program in the first folder of PATH that has it; empty: none has. Only absolute folders count: an empty entry
/// would be the current folder.
std::string gnuplot_program() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (std::string program = folder + "/gnuplot"; folder.starts_with('/') && access(program.c_str(), X_OK) == 0)
            return program;
    return "";
}

/// gnuplot between two pipes: no shell, and no file.
pid_t start_gnuplot(const Pipe& in, const Pipe& out, const Messages& messages) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in.ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, messages.file(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t ignored;
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &ignored);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    std::string name = "gnuplot";
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t child = -1;
    const int failed = posix_spawn(&child, gnuplot_program().c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (failed != 0)
        throw Error("chart: gnuplot cannot be started");
    return child;
}

/// Writes all of `text` and reads to the end, whichever the other side is ready for.
std::string exchange(Pipe& in, Pipe& out, std::string_view text) {
    fcntl(in.ends[1], F_SETFL, O_NONBLOCK);
    std::string output;
    std::array<char, 4096> part{};
    for (;;) {
        if (text.empty())
            in.close_end(1);
        std::array<pollfd, 2> ready{pollfd{out.ends[0], POLLIN, 0}, pollfd{in.ends[1], POLLOUT, 0}};
        if (poll(ready.data(), ready.size(), -1) < 0)
            continue;
        if (ready[1].revents != 0) {
            const ssize_t written = write(in.ends[1], text.data(), text.size());
            text.remove_prefix(written > 0                         ? static_cast<std::size_t>(written)
                               : errno == EAGAIN || errno == EINTR ? 0
                                                                   : text.size());
        }
        if (ready[0].revents == 0)
            continue;
        const ssize_t got = read(out.ends[0], part.data(), part.size());
        if (got == 0 || (got < 0 && errno != EINTR))
            return output;
        output.append(part.data(), static_cast<std::size_t>(got > 0 ? got : 0));
    }
}

} // namespace

bool have_gnuplot() { return !gnuplot_program().empty(); }

std::string run_gnuplot(const std::string& script) {
    Pipe in, out;
    const Messages messages;
    const pid_t child = start_gnuplot(in, out, messages);
    in.close_end(0);
    out.close_end(1);
    const std::string output = exchange(in, out, script);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (status != 0 || output.empty())
        throw Error("chart: gnuplot failed" + messages.line());
    return output;
}

std::string gnuplot_quoted(std::string_view text) {
    std::string out(1, '\'');
    for (const char c : text) {
        if (c == '\'')
            out += c;
        out += c;
    }
    out += '\'';
    return out;
}

} // namespace lockstep
