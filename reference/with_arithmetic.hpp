#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/switches.hpp"
#include "reference/portable.hpp"

namespace lockstep {

/// Calls `pass` with the arithmetic that a profile and the `arithmetic` switch name. It may refer to the profile's own
/// tables, and be copied to any number of threads.
template <class Pass> decltype(auto) with_arithmetic(const Profile& profile, const Switches& switches, Pass&& pass) {
    if (switches.arithmetic == ArithmeticSwitch::exact)
        return pass(Portable{});
    if (profile.roots != nullptr)
        return pass(DriverRoots(*profile.roots));
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
