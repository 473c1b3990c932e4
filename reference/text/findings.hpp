#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/error.hpp"

namespace lockstep::text {

/// Where in a run something is done.
struct Place {
    std::uint32_t line = 0, invocation = 0; ///< of the text; its number in the dispatch
    bool operator==(const Place&) const = default;
};

/// What a run of a text came by that GLSL does not allow, or gives no value.
struct Finding {
    std::string rule;                ///< "index out of bounds (GLSL 4.60, 5.11)"
    std::string what;                ///< of the first time
    Place place;                     ///< the first
    std::optional<Place> other = {}; ///< of a race: who touched the memory before
    std::size_t times = 1;
};

inline constexpr std::string_view endless_rule = "loop that does not end (GLSL 4.60, 6.4)";

/// An invocation took more branches than it may.
struct DoesNotEnd : Error {
    DoesNotEnd(const std::string& what, Place at) : Error(what), place(at) {}
    Place place;
};

/// Findings by rule and lines, in the order in which they were first made.
class Findings {
  public:
    /// `what()`: words for the first time.
    template <class What>
    void add(std::string_view rule, Place place, const What& what, std::optional<Place> other = {}) {
        const auto is_known = [&](const Finding& one) {
            if (!other || !one.other)
                return one.place.line == place.line;
            return (one.place.line == place.line && one.other->line == other->line) ||
                   (one.place.line == other->line && one.other->line == place.line);
        };
        for (Finding& one : all_)
            if (one.rule == rule && is_known(one)) {
                ++one.times;
                return;
            }
        all_.push_back({std::string(rule), what(), place, other});
    }
    template <class Is> void remove(const Is& is) { std::erase_if(all_, is); }
    [[nodiscard]] const std::vector<Finding>& all() const { return all_; }

  private:
    std::vector<Finding> all_;
};

} // namespace lockstep::text
