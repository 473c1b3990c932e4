#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

/// What makes a green run prove little (CheckReport::untried): a pass never ran, or ran over nothing, or left what was
/// there, half of them did, many images are one colour, or what agrees is NaN.
class UntriedParts {
  public:
    /// A buffer or image before a pass and after it.
    struct Step {
        const View& from;
        const View& made;
        [[nodiscard]] std::size_t changed() const;
    };

    /// A pass that no frame ran.
    void note_idle(std::string_view pass) { idle_.emplace(pass); }
    /// A pass that ran over nothing in every frame.
    void note_empty(const ItemPass& pass) { empty_.emplace(pass.name(), pass.stage()); }
    /// One run of a pass on either side.
    void note(const ItemPass& pass, const Step& reference, const Step& gpu);

    [[nodiscard]] std::vector<std::string> texts(const CheckReport& report) const;
    /// The passes that left what was there on the GPU, in all frames.
    [[nodiscard]] std::vector<std::string> without_effect() const;

  private:
    std::set<std::string> idle_;
    std::map<std::string, PassStage> empty_;
    struct Effect {
        bool changes = false;     ///< on the GPU anything, in any frame
        std::uint64_t missed = 0; ///< items that the reference changed meanwhile
        bool derived = false;
        std::string item = {}; ///< its name
    };
    std::map<std::string, Effect> effects_; ///< by pass that ran
    std::map<std::uint8_t, bool>
        uniform_; ///< images that were made, and whether all of their items were alike each time
};

} // namespace lockstep
