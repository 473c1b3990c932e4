#pragma once
#include <atomic>

namespace lockstep {

/// The program's alone, first thing in main. A signal that ends the program, and a library that calls exit(), take the
/// temporary files along (temporary.hpp); the status is then `status_of_exit`. Nobody reading a pipe and a limit on the
/// size of files are no signals but errors of the write. Signals that were ignored stay so. A crash in the driver, and
/// under a tight limit (environment.hpp) any crash, want of memory, and a driver that waits for ever, end it with one
/// line that names the limit and with `status_of_exit`.
void own_signals(int status_of_exit);

/// Last thing in main: what calls exit() from now on is main itself.
void leave_main();

extern std::atomic<bool> interrupted;

/// While one lives, the first Ctrl-C only sets `interrupted`; a second one ends the program.
class InterruptHandler {
  public:
    InterruptHandler();
    ~InterruptHandler();
    InterruptHandler(const InterruptHandler&) = delete;
    InterruptHandler& operator=(const InterruptHandler&) = delete;

    /// Forgets a Ctrl-C; the next one is the first again.
    void again();
};

/// While one lives, signals wait: for a few system calls that belong together.
class SignalsWait {
  public:
    SignalsWait();
    ~SignalsWait();
    SignalsWait(const SignalsWait&) = delete;
    SignalsWait& operator=(const SignalsWait&) = delete;

  private:
    bool outermost_;
};

} // namespace lockstep
