#include "crosscheck/files/signals.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <pthread.h>
#include <unistd.h>

#include "crosscheck/files/temporary.hpp"

namespace lockstep {
namespace {

constexpr std::array ending{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF};
constexpr std::array faults{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS};

pid_t owner = 0; ///< a child process has no temporary files of its own
pthread_t main_thread;
int status_of_exit = 0;
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

void on_fault(int signal) {
    if (getpid() == owner)
        remove_temporaries();
    end_by(signal);
}

/// Left to `handler`, unless the program was started with another wish.
void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL)
        return;
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

/// libgomp ends the program with status 1 where it cannot go on, and drivers do as they like.
void on_exit_called() {
    if (!in_main || getpid() != owner)
        return;
    remove_temporaries();
    std::fflush(stdout);
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
    for (const int signal : ending)
        handle(signal, on_ending);
    for (const int signal : faults)
        handle(signal, on_fault);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
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
