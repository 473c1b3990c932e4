#pragma once
#include <stdexcept>
#include <string>

namespace lockstep {

/// Something the user can put right: a file, a value, a context that is missing.
/// The message is one line and says what is wrong, where, and what would be right.
/// Programs end with status 2 on it. Broken invariants are asserts, not Errors.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace lockstep
