#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/switches.hpp"
#include "reference/portable.hpp"

namespace lockstep {

/// Calls `pass` with the policy type that a profile and the `arithmetic` switch name.
template <class Pass> decltype(auto) with_arithmetic(const Profile& profile, const Switches& switches, Pass&& pass) {
    if (switches.arithmetic == ArithmeticSwitch::exact)
        return pass(Portable{});
    if (profile.roots != nullptr) {
        DriverRoots::tables = profile.roots.get();
        return pass(DriverRoots{});
    }
    switch (profile.dot) {
    case DotOrder::right_to_left:
        return pass(RightToLeft{});
    case DotOrder::fused_chain:
        return pass(FusedChain{});
    case DotOrder::left_to_right:
        break;
    }
    return pass(Strict{});
}

} // namespace lockstep
