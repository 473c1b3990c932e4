#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/switches.hpp"
#include "reference/portable.hpp"

namespace lockstep {

/// Every arithmetic of arithmetic.hpp as one type, chosen at run time: its bits, for what is compiled once and is not a
/// pass's own loop. Refers to the tables.
class PlainArithmetic : public Strict {
  public:
    PlainArithmetic(DotOrder order, const RootTables* tables) : order_(order), tables_(tables) {}

    [[nodiscard]] float dot(glm::vec3 a, glm::vec3 b) const {
        switch (order()) {
        case DotOrder::right_to_left:
            return RightToLeft::dot(a, b);
        case DotOrder::fused_chain:
            return FusedChain::dot(a, b);
        case DotOrder::left_to_right:
            break;
        }
        return Strict::dot(a, b);
    }
    [[nodiscard]] float reciprocal(float a) const {
        return tables_ != nullptr ? tables_->reciprocal_of(a) : Strict::reciprocal(a);
    }
    [[nodiscard]] float divide(float a, float b) const {
        return tables_ != nullptr ? a * reciprocal(b) : Strict::divide(a, b);
    }
    [[nodiscard]] float inverse_sqrt(float a) const {
        return tables_ != nullptr ? tables_->inverse_sqrt_of(a) : 1.0F / std::sqrt(a);
    }
    [[nodiscard]] float sqrt(float a) const {
        return tables_ != nullptr ? reciprocal(inverse_sqrt(a)) : Strict::sqrt(a);
    }
    [[nodiscard]] float length(glm::vec3 v) const { return sqrt(dot(v, v)); }
    [[nodiscard]] glm::vec3 normalize(glm::vec3 v) const { return scale(v, inverse_sqrt(dot(v, v))); }

  private:
    /// The tables come with their driver's order.
    [[nodiscard]] DotOrder order() const { return tables_ != nullptr ? DotOrder::fused_chain : order_; }
    DotOrder order_;
    const RootTables* tables_;
};

/// As with_arithmetic, with two types for all: PlainArithmetic and Portable.
template <class Pass>
decltype(auto) with_plain_arithmetic(const Profile& profile, const Switches& switches, Pass&& pass) {
    if (switches.arithmetic == ArithmeticSwitch::exact)
        return pass(Portable{});
    return pass(PlainArithmetic(profile.dot, profile.roots.get()));
}

} // namespace lockstep
