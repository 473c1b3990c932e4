#pragma once
#include <compare>
#include <string_view>

namespace lockstep {

/// What a tie is about: the name of the site that decided, and what its margins are measured in.
struct TieKind {
    std::string_view name, unit;

    friend bool operator==(const TieKind& a, const TieKind& b) { return a.name == b.name; }
    friend auto operator<=>(const TieKind& a, const TieKind& b) { return a.name <=> b.name; }
};

/// Those of rasterisation.
inline constexpr TieKind point_edge_tie{"point edge", "/256 pixel"}; ///< window position at a pixel's edge
inline constexpr TieKind depth_tie{"depth", "of depth"};             ///< two depths as good as equal

/// A decision that legal rounding can take either way, and how far its operands are from the border.
struct Tie {
    TieKind kind;
    double margin = 0.0;
};

} // namespace lockstep
