#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/profile.hpp"
#include "reference/portable.hpp"

namespace lockstep {

/// Whether dot, length and normalize sum in one order, one of those that have an arithmetic of their own, and normalize
/// is a product.
inline bool has_fast_orders(const Profile& profile) {
    return profile.one_order() && !profile.normalize_divides && profile.dot <= DotOrder::fused_chain &&
           (profile.roots == nullptr || profile.dot == DotOrder::fused_chain);
}

/// Calls `pass` with the arithmetic that a profile and the `arithmetic` switch name. It may refer to the profile's own
/// tables, and be copied to any number of threads.
template <class Pass> decltype(auto) with_arithmetic(const Profile& profile, ArithmeticSwitch arithmetic, Pass&& pass) {
    if (arithmetic == ArithmeticSwitch::exact)
        return pass(Portable{});
    if (!has_fast_orders(profile))
        return pass(OwnOrders(profile));
    if (profile.roots != nullptr)
        return pass(DriverRoots(*profile.roots));
    switch (profile.dot) {
    case DotOrder::right_to_left:
        return pass(RightToLeft{});
    case DotOrder::fused_chain:
        return pass(FusedChain{});
    default:
        break;
    }
    return pass(Strict{});
}

} // namespace lockstep
