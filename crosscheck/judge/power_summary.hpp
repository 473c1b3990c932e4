#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// How much a run proved: of the mistakes that have names, those that would have shown in the states that it really
/// had.
struct PowerSummary {
    struct Mistake {
        std::string name, meaning;
        std::optional<int> first_frame = {}; ///< in which it would have shown
        bool changes = false;                ///< something, in what was tried
        std::vector<std::string> reasons =
            {};                   ///< why it could not show, as far as these frames tell; the first is told
        bool refutes = false;     ///< where it would have shown and nothing diverges, it was not made
        std::string why_not = {}; ///< it did not show, once that is known: "no hit had two in range"
        std::string pass = {};    ///< that it is made in, where passes have mistakes of one name
    };
    /// Something in which mistakes show, and how often the run had it.
    struct Situation {
        std::string name; ///< "hits with two in range"
        std::uint64_t count = 0;
    };
    std::vector<Mistake> mistakes; ///< those that would be mistakes with the run's switches
    std::vector<Situation> situations;

    [[nodiscard]] std::size_t seen() const {
        return static_cast<std::size_t>(std::count_if(mistakes.begin(), mistakes.end(),
                                                      [](const Mistake& m) { return m.first_frame.has_value(); }));
    }
    /// "square_without_z", or "square_without_z (update)" where another pass has one of the name.
    [[nodiscard]] std::string shown_name(const Mistake& mistake) const {
        const auto of_name = [&](const Mistake& other) { return other.name == mistake.name; };
        const bool is_only = std::count_if(mistakes.begin(), mistakes.end(), of_name) < 2;
        return is_only || mistake.pass.empty() ? mistake.name : mistake.name + " (" + mistake.pass + ")";
    }
    /// 0 to 1; 0 where nothing was tried.
    [[nodiscard]] double share() const {
        return mistakes.empty() ? 0.0 : static_cast<double>(seen()) / static_cast<double>(mistakes.size());
    }
    /// Of the mistakes that have not shown in the whole run, why.
    void conclude() {
        for (Mistake& mistake : mistakes)
            if (!mistake.first_frame)
                mistake.why_not = mistake.changes           ? "what it changes is legal, too"
                                  : mistake.reasons.empty() ? "it changes none of the items that were tried"
                                                            : mistake.reasons.front();
    }
};

} // namespace lockstep
