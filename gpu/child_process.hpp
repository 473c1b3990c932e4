#pragma once
#include <functional>
#include <stdexcept>
#include <string>

#include "reference/model/error.hpp"

namespace lockstep {

struct ChildRules {
    const char* subject; ///< what may fail there, as messages call it: "the driver"
    int seconds = 20;    ///< to wait for it, or of its processor time where it is fenced; then it is killed
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

/// A fenced child got no turn. It says nothing about what was read, so nothing that goes on without an answer may take
/// it for an Error.
class ChildStarved : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Runs `work` in a child process, without the terminal, and returns the bytes that it gives. Throws what it throws as
/// Error, ChildFailed, ChildStarved, or NoChildProcess.
std::string in_child(const ChildRules& rules, const std::function<std::string()>& work);

/// The same; in this process where the system starts none.
std::string in_child_if_possible(const ChildRules& rules, const std::function<std::string()>& work);

} // namespace lockstep
