#pragma once
#include <string>

#include "crosscheck/collision/judge/check.hpp"

namespace lockstep {

/// The state hash of every frame, one line a frame: "FRAME REFERENCE GPU". Two files made on different machines can be
/// compared with diff.
class HashFile {
  public:
    void add(const ComparedFrame& frame);
    [[nodiscard]] const std::string& text() const { return lines_; }

  private:
    std::string lines_;
};

} // namespace lockstep
