#include "tests/cli/run_program.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lockstep::test {
namespace {

constexpr int longest_silence = 120'000; ///< milliseconds without a word on a terminal; then it hangs

/// Becomes lockstep. Only in a child process.
[[noreturn]] void become_lockstep(const std::vector<std::string>& arguments) {
    std::vector<char*> argv{const_cast<char*>("lockstep")};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(LOCKSTEP_PROGRAM, argv.data());
    _exit(127);
}

void enter(const Surroundings& surroundings) {
    for (const auto& [name, value] : surroundings.environment)
        setenv(name.c_str(), value.c_str(), 1);
    if (surroundings.largest_file) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{*surroundings.largest_file, *surroundings.largest_file};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (!surroundings.folder.empty() && chdir(surroundings.folder.c_str()) != 0)
        _exit(127);
    if (surroundings.memory) {
        const rlimit limit{*surroundings.memory, *surroundings.memory};
        setrlimit(RLIMIT_AS, &limit);
    }
    if (surroundings.stack) {
        const rlimit limit{*surroundings.stack, *surroundings.stack};
        setrlimit(RLIMIT_STACK, &limit);
    }
    if (surroundings.processes) {
        constexpr uid_t without_processes = 61234;
        if (getuid() == 0 &&
            (setgroups(0, nullptr) != 0 || setgid(without_processes) != 0 || setuid(without_processes) != 0))
            _exit(127);
        const rlimit limit{*surroundings.processes, *surroundings.processes};
        setrlimit(RLIMIT_NPROC, &limit);
    }
    if (surroundings.files) {
        const rlimit limit{*surroundings.files, *surroundings.files};
        setrlimit(RLIMIT_NOFILE, &limit);
    }
    if (surroundings.standard_input) {
        int in[2];
        if (pipe(in) != 0)
            _exit(127);
        const std::string& text = *surroundings.standard_input;
        if (write(in[1], text.data(), text.size()) != static_cast<ssize_t>(text.size()))
            _exit(127);
        close(in[1]);
        dup2(in[0], STDIN_FILENO);
    }
    if (surroundings.nobody_reads) {
        int out[2];
        if (pipe(out) != 0)
            _exit(127);
        close(out[0]);
        dup2(out[1], STDOUT_FILENO);
    }
    if (surroundings.standard_output && surroundings.standard_output->empty())
        close(STDOUT_FILENO);
    else if (surroundings.standard_output)
        dup2(open(surroundings.standard_output->c_str(), O_WRONLY), STDOUT_FILENO);
    for (const int stream : surroundings.closed)
        close(stream);
}

/// Appends what can be read; false at the end. A terminal whose other side has closed ends with EIO.
bool read_some(int file, std::string& text) {
    std::array<char, 4096> chunk{};
    const ssize_t count = read(file, chunk.data(), chunk.size());
    if (count <= 0)
        return false;
    text.append(chunk.data(), static_cast<std::size_t>(count));
    return true;
}

void wait_for(pid_t child, Outcome& outcome) {
    int status = 0;
    if (waitpid(child, &status, 0) != child)
        throw std::runtime_error("waitpid failed");
    if (WIFEXITED(status))
        outcome.status = WEXITSTATUS(status);
    else
        outcome.signal = WTERMSIG(status);
}

} // namespace

Outcome run_lockstep(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    int out[2];
    int err[2];
    if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0)
        throw std::runtime_error("pipe2 failed");
    const pid_t child = fork();
    if (child < 0)
        throw std::runtime_error("fork failed");
    if (child == 0) {
        dup2(out[1], STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
        enter(surroundings);
        become_lockstep(arguments);
    }
    close(out[1]);
    close(err[1]);
    Outcome outcome;
    std::array<pollfd, 2> ends{pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        poll(ends.data(), ends.size(), -1);
        for (pollfd& end : ends)
            if (end.fd >= 0 && end.revents != 0 && !read_some(end.fd, end.fd == out[0] ? outcome.out : outcome.err))
                end.fd = -1;
    }
    close(out[0]);
    close(err[0]);
    wait_for(child, outcome);
    return outcome;
}

Outcome run_lockstep_until(const std::function<bool()>& ready, int signal, const std::vector<std::string>& arguments) {
    const pid_t child = fork();
    if (child < 0)
        throw std::runtime_error("fork failed");
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        become_lockstep(arguments);
    }
    while (!ready() && waitpid(child, nullptr, WNOHANG) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    kill(child, signal);
    Outcome outcome;
    wait_for(child, outcome);
    return outcome;
}

std::string why_no_terminal() {
    int master = -1;
    int terminal = -1;
    if (openpty(&master, &terminal, nullptr, nullptr, nullptr) != 0)
        return std::string("no pseudo-terminal: ").append(std::strerror(errno)).append("; is /dev/pts mounted?");
    close(master);
    close(terminal);
    return "";
}

Outcome run_lockstep_on_terminal(const std::vector<std::string>& arguments, const std::vector<Typed>& typed,
                                 unsigned short columns, const Surroundings& surroundings) {
    int terminal = -1;
    const winsize size{24, columns, 0, 0};
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child < 0)
        throw std::runtime_error("forkpty failed");
    if (child == 0) {
        setenv("TERM", "xterm", 0); // where the test itself has no terminal
        enter(surroundings);
        become_lockstep(arguments);
    }
    Outcome outcome;
    std::size_t next = 0, from = 0;
    const auto shows_more = [&] {
        pollfd end{terminal, POLLIN, 0};
        if (poll(&end, 1, longest_silence) != 0)
            return read_some(terminal, outcome.out);
        kill(child, SIGKILL);
        outcome.out += "\n(silent for too long)\n";
        return false;
    };
    while (shows_more())
        while (next < typed.size()) {
            const std::size_t at = outcome.out.find(typed[next].trigger, from);
            if (at == std::string::npos)
                break;
            from = at + typed[next].trigger.size();
            const std::string& text = typed[next++].text;
            if (write(terminal, text.data(), text.size()) < 0)
                throw std::runtime_error("the terminal takes no keys");
        }
    close(terminal);
    wait_for(child, outcome);
    return outcome;
}

Outcome run_lockstep_on_terminal(const std::vector<std::string>& arguments, const std::string& trigger,
                                 const std::string& typed, unsigned short columns, const Surroundings& surroundings) {
    return run_lockstep_on_terminal(
        arguments, typed.empty() ? std::vector<Typed>{} : std::vector<Typed>{{trigger, typed}}, columns, surroundings);
}

} // namespace lockstep::test
