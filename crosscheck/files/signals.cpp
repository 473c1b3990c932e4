#include "crosscheck/files/signals.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <string>
#include <string_view>

#include <pthread.h>
#include <sys/time.h>
#include <unistd.h>

#include "crosscheck/files/temporary.hpp"
#include "gpu/driver_call.hpp"
#include "gpu/environment.hpp"

namespace lockstep {
namespace {

constexpr std::array ending{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF};
constexpr std::array faults{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS};

pid_t owner = 0; ///< a child process has no temporary files of its own
pthread_t main_thread;
int status_of_exit = 0;
std::array<char, 256> limits{}; ///< tight_limits(), for signal handlers
std::atomic<bool> in_main{false};
std::atomic<bool> interrupts_are_noted{false};
thread_local int waiting = 0;
thread_local sigset_t mask_before;

[[noreturn]] void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, signal);
    pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
    std::raise(signal);
    _exit(128 + signal);
}

/// Temporary files are made in the main thread, so it alone removes them: it is then not making any.
void on_ending(int signal) {
    if (getpid() != owner)
        end_by(signal);
    if (pthread_equal(pthread_self(), main_thread) == 0) {
        pthread_kill(main_thread, signal);
        return;
    }
    if (signal == SIGINT && interrupts_are_noted.exchange(false)) {
        interrupted = true;
        return;
    }
    remove_temporaries();
    end_by(signal);
}

/// Text for standard error, without memory of its own.
class Line {
  public:
    Line& operator<<(std::string_view text) {
        const std::size_t taken = std::min(text.size(), text_.size() - size_);
        std::copy_n(text.begin(), taken, text_.begin() + size_);
        size_ += taken;
        return *this;
    }
    Line& operator<<(int number) {
        std::array<char, 12> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
        return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
    }
    void show() {
        *this << "\n";
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text_.data(), size_);
    }

  private:
    std::array<char, 1024> text_{};
    std::size_t size_ = 0;
};

/// As an error that nothing can be unwound for ends the program: drivers without memory hang in it.
[[noreturn]] void end_with(Line& line) {
    if (limits[0] != '\0')
        line << "; " << limits.data();
    line.show();
    remove_temporaries();
    _exit(status_of_exit);
}

/// A crash in the driver, or under a limit that drivers crash at, is no crash of the program's.
void on_fault(int signal) {
    const char* const call = DriverCall::running();
    if (getpid() == owner && (call != nullptr || limits[0] != '\0')) {
        Line line;
        line << "lockstep: " << (call != nullptr ? "the driver" : "the program") << " crashed";
        if (call != nullptr)
            line << " in " << call;
        line << " with signal " << signal;
        if (const char* description = sigdescr_np(signal); description != nullptr)
            line << " (" << description << ")";
        end_with(line);
    }
    if (getpid() == owner)
        remove_temporaries();
    end_by(signal);
}

void on_no_memory() {
    if (getpid() != owner)
        throw std::bad_alloc();
    Line line;
    line << "lockstep: not enough memory";
    end_with(line);
}

/// A tick of the watch over calls into the driver, where limits are tight: one in which the process does nothing for so
/// long waits for what it was not given.
void on_tick(int) {
    constexpr int patience = 20; // ticks
    static const char* call = nullptr;
    static timespec used{};
    static int idle = 0;
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    const char* const running = DriverCall::running();
    const long spent = (now.tv_sec - used.tv_sec) * 1'000'000'000L + now.tv_nsec - used.tv_nsec;
    idle = running != nullptr && running == call && spent < 5'000'000 ? idle + 1 : 0;
    call = running;
    used = now;
    if (idle < patience || getpid() != owner)
        return;
    Line line;
    line << "lockstep: the driver hangs in " << call;
    end_with(line);
}

void watch_driver() {
    struct sigaction action {};
    action.sa_handler = on_tick;
    action.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &action, nullptr);
    const itimerval second{{1, 0}, {1, 0}};
    setitimer(ITIMER_REAL, &second, nullptr);
}

/// Left to `handler`, unless the program was started with another wish.
void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL)
        return;
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

/// What handlers of the main thread run on: a fault may be a stack that is full.
void have_signal_stack() {
    static std::array<char, std::size_t{64} << 10U> memory;
    stack_t stack{};
    stack.ss_sp = memory.data();
    stack.ss_size = memory.size();
    sigaltstack(&stack, nullptr);
}

/// libgomp ends the program with status 1 where it cannot go on, and drivers do as they like.
void on_exit_called() {
    if (!in_main || getpid() != owner)
        return;
    std::fflush(stdout);
    if (const char* const call = DriverCall::running(); call != nullptr || limits[0] != '\0') {
        Line line;
        line << "lockstep: " << (call != nullptr ? call : "a library") << " ended the program";
        end_with(line);
    }
    remove_temporaries();
    _exit(status_of_exit);
}

} // namespace

std::atomic<bool> interrupted{false};

void own_signals(int status) {
    owner = getpid();
    main_thread = pthread_self();
    status_of_exit = status;
    in_main = true;
    std::atexit(on_exit_called);
    have_signal_stack();
    remove_temporaries(); // makes their list, for which a handler may find no memory
    for (const int signal : ending)
        handle(signal, on_ending);
    for (const int signal : faults)
        handle(signal, on_fault);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string tight = tight_limits();
    tight.copy(limits.data(), limits.size() - 1);
    if (tight.empty())
        return;
    std::set_new_handler(on_no_memory);
    watch_driver();
}

void leave_main() { in_main = false; }

InterruptHandler::InterruptHandler() { interrupts_are_noted = true; }
InterruptHandler::~InterruptHandler() { interrupts_are_noted = false; }

void InterruptHandler::again() {
    interrupted = false;
    interrupts_are_noted = true;
}

SignalsWait::SignalsWait() : outermost_(waiting++ == 0) {
    if (!outermost_)
        return;
    sigset_t all;
    sigemptyset(&all);
    for (const int signal : ending)
        sigaddset(&all, signal);
    pthread_sigmask(SIG_BLOCK, &all, &mask_before);
}

SignalsWait::~SignalsWait() {
    --waiting;
    if (outermost_)
        pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
}

} // namespace lockstep
