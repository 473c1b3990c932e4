#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lockstep {

/// A line of a file.
struct FileLine {
    std::string file;
    std::uint32_t line = 0;
    auto operator<=>(const FileLine&) const = default;
};

/// Which lines of a stage's text its runs came to, and which sides of its decisions they took. Of the user's files
/// alone.
struct TextCoverage {
    struct Side {
        std::string never; ///< what holds where it was not taken: "was never true"
        bool is_taken = false;
    };
    struct Line {
        bool has_statement = false, is_reached = false;
        std::vector<std::vector<Side>> decisions = {}; ///< in their order there
    };
    std::string stage; ///< its file: "update.comp"
    std::string in;    ///< what ran: "3 frames"
    std::map<FileLine, Line> lines;

    /// Takes up other runs, of the same text or with other definitions.
    void add(const TextCoverage& other);
};

/// How many there are, and how many of them were reached or taken.
struct CoverageCount {
    std::size_t lines = 0, reached = 0, sides = 0, taken = 0;

    CoverageCount& operator+=(const CoverageCount& other);
    /// The smaller of both shares, from 0 to 1.
    [[nodiscard]] double share() const;
};
CoverageCount coverage_count(const TextCoverage& of);
CoverageCount coverage_count(std::span<const TextCoverage> all);

/// "40 of 44 lines, 11 of 14 branch sides".
std::string coverage_words(const CoverageCount& of);

/// "update.comp: 40 of 44 lines, 11 of 14 branch sides in 3 frames; :41 was never false, :52 to :55 never reached, and
/// 4 more".
std::string coverage_text(const TextCoverage& of);

nlohmann::json coverage_json(std::span<const TextCoverage> all);

} // namespace lockstep
