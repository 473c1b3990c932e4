#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace lockstep {

/// How much a run proved: of the mistakes that have names, those that would have shown in the states that it really
/// had.
struct PowerSummary {
    std::size_t mistakes = 0;
    std::vector<std::string> unseen; ///< that no item tried would have shown, in the table's order

    [[nodiscard]] std::size_t seen() const { return mistakes - unseen.size(); }
};

} // namespace lockstep
