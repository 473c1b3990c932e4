#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "crosscheck/judge/place.hpp"
#include "reference/interval.hpp"

namespace lockstep {

/// The set of legal floats that one number of an item lies in.
struct LegalFloats {
    std::size_t component = 0; ///< of the item's, in their order
    Interval set;

    /// In the number's own unit; no bound where the set is anything.
    [[nodiscard]] double width() const;
};

/// How wide the sets are that the GPU's items lie in, of each item the widest: as far as that may a shader be off and
/// stay legal.
class LegalWidths {
  public:
    struct Widest {
        Place place;
        LegalFloats floats;
    };

    void add(const Place& place, const LegalFloats& floats);
    void join(const LegalWidths& next);

    [[nodiscard]] const std::optional<Widest>& widest() const { return widest_; }
    /// What half of the items do not exceed, up to an eighth more.
    [[nodiscard]] double half() const;

  private:
    std::map<int, std::uint64_t> counts_; ///< by the exponent of a width's bound, in eighths of an octave
    std::optional<Widest> widest_;
};

} // namespace lockstep
