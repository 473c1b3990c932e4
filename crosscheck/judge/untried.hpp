#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep {

/// What makes a green run prove little (CheckReport::untried): nothing changed, a pass never ran, many images are one
/// colour, or what agrees is NaN.
class UntriedParts {
  public:
    /// A pass that no frame ran.
    void note_idle(std::string_view pass) { idle_.emplace(pass); }
    /// What a pass made of its buffer or image, from what was there.
    void note(std::uint8_t resource, const View& from, const View& made);

    [[nodiscard]] std::vector<std::string> texts(const CheckReport& report) const;

  private:
    std::set<std::string> idle_;
    bool changed_ = false; ///< anything, by any pass
    std::map<std::uint8_t, bool>
        uniform_; ///< images that were made, and whether all of their items were alike each time
};

} // namespace lockstep
