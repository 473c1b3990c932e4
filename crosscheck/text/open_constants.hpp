#pragma once
#include <cstddef>
#include <optional>
#include <set>
#include <string>

namespace lockstep {

/// A compiler folds expressions of constants: of `pow(-2.0, 2.0)` and `1 << 40` the module has what it made of them,
/// and no operand. Here such operands go through a function that returns what it is given, which nothing folds. What a
/// constant is declared with stays, and is computed once more beside it. Lines stay.
///
/// `text`: without macros and comments, as a preprocessor leaves it. `but`: lines that stay as they are. Null: there is
/// nothing of the kind.
std::optional<std::string> with_open_constants(const std::string& text, bool is_es, const std::set<std::size_t>& but);

} // namespace lockstep
