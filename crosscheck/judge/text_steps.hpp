#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crosscheck/judge/step_row.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

/// A value that the text of a pass's shader computes.
struct TextStep {
    std::string where; ///< FILE:LINE
    std::string name;  ///< of the variable and its component, or what is compared; empty: it has none
    std::uint32_t bits = 0;
    bool is_real = false, is_boolean = false, is_signed = true;
    bool compares = false; ///< numbers, of which `is_real` says what they are
};

/// What the text computes for one item, in order.
struct ItemSteps {
    std::string file;
    std::vector<TextStep> steps = {};
    std::map<std::string, std::string> lines = {}; ///< of the text, by TextStep::where
    std::vector<std::uint32_t> made = {};          ///< the item as the text makes it, component by component
    std::string not_known = {};                    ///< why there are none; empty: there are
};

/// The text of a pass's shader, run for single items.
class PassSteps {
  public:
    PassSteps() = default;
    virtual ~PassSteps() = default;
    PassSteps(const PassSteps&) = delete;
    PassSteps& operator=(const PassSteps&) = delete;

    [[nodiscard]] virtual ItemSteps of(const PassInput& in, std::size_t item, const Profile& profile) const = 0;
};

/// The number that a step makes, or a decision's answer.
Cell cell_of(const TextStep& step);

/// Gives each row of which the GPU told nothing the value that the text has in its place, and its line. Both are
/// aligned by value, in order; a row whose value the text never computes says so.
void align(std::vector<StepRow>& rows, const ItemSteps& text);

} // namespace lockstep
