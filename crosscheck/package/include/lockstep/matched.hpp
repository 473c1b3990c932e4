#pragma once
#include "lockstep/lockstep.hpp"

namespace lockstep {

/// A result as a test's assertion has it: true where it passed, and shown as its verdict. The result outlives it.
class Matched {
  public:
    explicit Matched(const MatchResult& result) : result_(result) {}
    explicit operator bool() const { return result_.passed(); }
    [[nodiscard]] std::string text() const { return result_.verdict(); }

  private:
    const MatchResult& result_;
};

} // namespace lockstep
