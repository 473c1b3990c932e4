#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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
/// No invocation makes sure that another is started or goes on.
inline constexpr std::string_view waiting_rule = "loop that waits for another invocation (GL 4.6, 7.13.1)";

/// A finding behind which nothing runs.
[[nodiscard]] inline bool is_endless(const Finding& one) {
    return one.rule == endless_rule || one.rule == waiting_rule;
}

/// Two invocations touch what no order is between; the beginning of its rule.
inline constexpr std::string_view race_rule = "race on ";
[[nodiscard]] inline bool is_race(const Finding& one) { return one.rule.starts_with(race_rule); }

/// An invocation stays in a loop, or took more branches than it may.
struct DoesNotEnd : Error {
    DoesNotEnd(const std::string& what, std::string_view by, Place at, std::string because)
        : Error(what), rule(by), place(at), why(std::move(because)) {}
    std::string_view rule;
    Place place;
    std::string why; ///< of a finding
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
