#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "reference/interval.hpp"
#include "reference/model/schema.hpp"

namespace lockstep {

/// The width of a set of floats, in the number's own unit; no bound where the set is anything.
[[nodiscard]] double width_of(const Interval& set);

/// The set of legal floats that one number of an item lies in.
struct LegalFloats {
    FieldId field;
    int component = 0;
    Interval set;

    [[nodiscard]] double width() const { return width_of(set); }
};

/// The widths of the sets that the items of one buffer or image lie in, the widest of each item: a shader may be off
/// by as much and stay legal.
class LegalWidths {
  public:
    struct Widest {
        int frame = 0;
        std::size_t index = 0; ///< of the item in its resource
        LegalFloats floats;
    };
    using Counts = std::map<int, std::uint64_t>; ///< by the exponent of a width's bound, in eighths of an octave

    LegalWidths(const Schema& schema, std::uint8_t resource);
    /// What was counted before.
    LegalWidths(const Schema& schema, std::uint8_t resource, Counts counts, const std::optional<Widest>& widest);

    /// The sets of an item: one for each component of the resource. Integers have no width.
    void add(int frame, std::size_t index, std::span<const Interval> sets);
    void join(const LegalWidths& next);

    [[nodiscard]] const std::optional<Widest>& widest() const { return widest_; }
    [[nodiscard]] const Counts& counts() const { return counts_; }
    /// What half of the items do not exceed, up to an eighth more.
    [[nodiscard]] double half() const;

  private:
    struct Part {
        FieldId field;
        int component = 0;
        bool is_float = true;
    };

    std::vector<Part> parts_; ///< of an item, in their order
    Counts counts_;
    std::optional<Widest> widest_;
};

} // namespace lockstep
