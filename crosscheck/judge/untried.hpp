#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

/// What makes a green run prove little (CheckReport::untried): a pass never ran, half of them left what was
/// there, many images are one colour, or what agrees is NaN.
class UntriedParts {
  public:
    /// A pass that no frame ran.
    void note_idle(std::string_view pass) { idle_.emplace(pass); }
    /// What a pass made of its buffer or image, from what was there.
    void note(const ItemPass& pass, const View& from, const View& made);

    [[nodiscard]] std::vector<std::string> texts(const CheckReport& report) const;
    /// The passes that left what was there in all frames.
    [[nodiscard]] std::vector<std::string> without_effect() const;

  private:
    std::set<std::string> idle_;
    struct Effect {
        bool changes = false; ///< anything, in any frame
        bool derived = false;
    };
    std::map<std::string, Effect> effects_; ///< by pass that ran
    std::map<std::uint8_t, bool>
        uniform_; ///< images that were made, and whether all of their items were alike each time
};

} // namespace lockstep
