#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::text {

/// What a run of a text came by that GLSL does not allow, or gives no value.
struct Finding {
    std::string rule; ///< "index out of bounds (GLSL 4.60, 5.11)"
    std::string what;
    std::uint32_t line = 0;
    std::uint32_t invocation = 0; ///< the first, by its number in the dispatch
    std::size_t times = 1;
};

/// Findings by rule and line, in the order in which they were first made.
class Findings {
  public:
    void add(std::string_view rule, std::string_view what, std::uint32_t line, std::uint32_t invocation) {
        for (Finding& one : all_)
            if (one.line == line && one.rule == rule) {
                ++one.times;
                return;
            }
        all_.push_back({std::string(rule), std::string(what), line, invocation});
    }
    [[nodiscard]] const std::vector<Finding>& all() const { return all_; }

  private:
    std::vector<Finding> all_;
};

} // namespace lockstep::text
