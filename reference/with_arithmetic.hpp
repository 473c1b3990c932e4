#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/switches.hpp"

namespace lockstep {

/// Calls `pass` with the policy type that a profile and the `arithmetic` switch name.
template <class Pass> decltype(auto) with_arithmetic(const Profile& profile, Pass&& pass) {
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
