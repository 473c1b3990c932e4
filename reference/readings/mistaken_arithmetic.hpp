#pragma once
#include <span>

#include <glm/vec3.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/profile.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/readings/mistake.hpp"
#include "reference/readings/mistaken.hpp"

namespace lockstep {

/// The exact preset's arithmetic, its sums from either end.
class PortableEitherWay : public Portable {
  public:
    explicit PortableEitherWay(bool right_to_left) : right_to_left_(right_to_left) {}
    [[nodiscard]] float dot(glm::vec3 a, glm::vec3 b) const {
        if (!right_to_left_)
            return Portable::dot(a, b);
        return add(multiply(a.x, b.x), add(multiply(a.y, b.y), multiply(a.z, b.z)));
    }
    [[nodiscard]] float length(glm::vec3 v) const { return sqrt(dot(v, v)); }
    [[nodiscard]] glm::vec3 normalize(glm::vec3 v) const {
        return right_to_left_ ? scale(v, inverse_sqrt(dot(v, v))) : Portable::normalize(v);
    }

  private:
    bool right_to_left_;
};

/// Calls `work` with a pass's arithmetic as the mistakes have it: the profile's, or a wrong one. `may_fuse`: whether
/// Change::products_fused counts.
template <bool may_fuse, class Work>
decltype(auto) with_mistaken_arithmetic(const Profile& profile, ArithmeticSwitch arithmetic,
                                        std::span<const Mistake> made, const Work& work) {
    const auto has = [&](Change change) { return is_among(change, made); };
    const auto fused_or_not = [&](auto fp) {
        if constexpr (may_fuse)
            if (has(Change::products_fused))
                return work(FusedProducts(fp));
        return work(fp);
    };
    if (arithmetic == ArithmeticSwitch::exact || has(Change::portable_arithmetic))
        return fused_or_not(PortableEitherWay(has(Change::sums_right_to_left)));
    // The driver's tables come with its own orders of sums.
    const auto in_order = [](DotOrder order) { return PlainArithmetic(order, order, order, nullptr); };
    if (has(Change::sums_fused))
        return fused_or_not(in_order(DotOrder::fused_chain));
    if (has(Change::sums_right_to_left))
        return fused_or_not(in_order(DotOrder::right_to_left));
    if (has(Change::sums_left_to_right))
        return fused_or_not(in_order(DotOrder::left_to_right));
    return fused_or_not(PlainArithmetic(profile));
}

} // namespace lockstep
