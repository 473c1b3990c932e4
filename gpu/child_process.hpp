#pragma once
#include <functional>
#include <string>

#include "reference/model/error.hpp"

namespace lockstep {

struct ChildRules {
    const char* subject; ///< what may fail there, as messages call it: "the driver"
    int seconds = 20;    ///< to wait for it; then it is killed
    bool fenced = false; ///< it opens no file and starts nothing (syscall_fence.hpp); memory and time are bounded
};

/// The system starts no further process.
class NoChildProcess : public Error {
  public:
    using Error::Error;
};

/// How a child process ended without an answer: "SUBJECT crashed with signal 11 (Segmentation fault)".
class ChildFailed : public Error {
  public:
    using Error::Error;
};

/// Runs `work` in a child process, without the terminal, and returns the bytes that it gives. Throws what it throws as
/// Error, ChildFailed, or NoChildProcess.
std::string in_child(const ChildRules& rules, const std::function<std::string()>& work);

/// The same; in this process where the system starts none.
std::string in_child_if_possible(const ChildRules& rules, const std::function<std::string()>& work);

} // namespace lockstep
