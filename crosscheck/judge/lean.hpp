#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <glm/vec2.hpp>

namespace lockstep {

/// A texel that holds what belongs into the pixel beside it, and what that says of a shift of everything.
struct Lean {
    glm::ivec2 direction{0}; ///< signs, x and y up: where the shift would point
    bool right_half = false; ///< of the image
    bool upper_half = false;
    bool beyond_rounding = true; ///< further than window coordinates as accurate as GLSL's, on the known grid, explain
    std::uint64_t place = 0;     ///< the same window position has the same number, in whatever frame
};

/// The leans of a run, each place once.
class Leans {
  public:
    enum Direction : std::uint8_t { left, right, down, up };
    static constexpr std::array<std::string_view, 4> names{"left", "right", "down", "up"};

    void add(const Lean& lean);
    /// Those that were counted, in the order in which they came.
    [[nodiscard]] const std::vector<Lean>& counted() const { return counted_; }

    [[nodiscard]] bool any() const { return !counted_.empty(); }
    [[nodiscard]] std::uint64_t count(Direction d) const { return count_[d][0] + count_[d][1]; }
    [[nodiscard]] std::uint64_t beyond_rounding(Direction d) const { return beyond_[d][0] + beyond_[d][1]; }
    /// Whether, in both halves of the image across that axis, what lies beyond rounding goes this way so often that a
    /// fair coin would do it with a probability of less than 2^-64 in each half.
    [[nodiscard]] bool one_sided(Direction d) const;
    /// Whether in both halves nothing beyond rounding goes the other way, and something goes this way.
    [[nodiscard]] bool all_this_way(Direction d) const;
    /// "shifted_right", "shifted_left_and_up" by those directions for which `test` holds; empty: none.
    template <class Test> [[nodiscard]] std::string shift(const Test& test) const {
        std::string name;
        for (const Direction d : {left, right, down, up})
            if (test(d))
                name += std::string(name.empty() ? "shifted_" : "_and_") + std::string(names[d]);
        return name;
    }

  private:
    using Halves = std::array<std::uint64_t, 2>;
    std::array<Halves, 4> count_{}, beyond_{};
    std::unordered_set<std::uint64_t> seen_; ///< places
    std::vector<Lean> counted_;
};

} // namespace lockstep
