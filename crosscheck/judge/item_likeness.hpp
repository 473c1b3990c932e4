#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// How the values of a pass's items that a mistake would make stand to those of the GPU.
class ItemLikeness {
  public:
    /// `verdicts`: on items that differ, by index; these and the pass outlive this.
    explicit ItemLikeness(const JudgedPass& pass, std::span<const ItemVerdict> verdicts = {})
        : pass_(pass), verdicts_(verdicts), parts_(components(pass.gpu.about())) {}

    [[nodiscard]] const JudgedPass& pass() const { return pass_; }
    [[nodiscard]] const std::vector<Component>& parts() const { return parts_; }

    /// Whether an item's words, made with a mistake, are the GPU's, but for the sign of zero, which depends on how a
    /// mistake was written down.
    [[nodiscard]] bool are_gpus(std::size_t item, std::span<const std::uint32_t> words) const;
    /// Whether they may be the GPU's of an item that is right: the same bits, or as near as the reference's are that
    /// differ by what is legal, or near and legal there themselves.
    [[nodiscard]] bool may_be_gpus(std::size_t item, std::span<const std::uint32_t> words) const;
    /// How far they are from the GPU's, in ULP of a vector's greatest component (ulps_apart): the most of all fields.
    [[nodiscard]] double ulps_from_gpus(std::size_t item, std::span<const std::uint32_t> words) const;
    /// The same of two mistakes' words.
    [[nodiscard]] double ulps_between(std::size_t item, std::span<const std::uint32_t> a,
                                      std::span<const std::uint32_t> b) const;
    /// Whether they are as near the GPU's as a divergent item's legal sets are wide; the same bits where these are
    /// points, and of integers.
    [[nodiscard]] bool are_within_leeway(std::size_t item, std::span<const std::uint32_t> words) const;
    /// Whether the GPU's are so much farther from the reference's that coming near them tells anything.
    [[nodiscard]] bool is_off_by_more(std::size_t item) const;
    /// The same of the reference's own.
    [[nodiscard]] bool are_references(std::size_t item, std::span<const std::uint32_t> words) const;
    [[nodiscard]] bool are_near_references(std::size_t item, std::span<const std::uint32_t> words) const;
    /// Whether the reference differs from the GPU by rounding alone.
    [[nodiscard]] bool is_off_by_rounding(std::size_t item) const;

  private:
    /// The legal sets of a divergent item; empty: points.
    [[nodiscard]] std::span<const Interval> sets_of(std::size_t item) const;
    [[nodiscard]] bool are_legal(std::size_t item, std::span<const std::uint32_t> words) const;
    [[nodiscard]] bool are(const View& side, std::size_t item, std::span<const std::uint32_t> words) const;

    const JudgedPass& pass_;
    std::span<const ItemVerdict> verdicts_;
    mutable std::mutex mutex_;
    mutable std::map<std::size_t, std::vector<ItemOutcome>> outcomes_; ///< of items that were asked for
    std::vector<Component> parts_;
};

/// The same bits, but for the sign of zero.
bool alike(Value a, Value b);

} // namespace lockstep
