#pragma once
#include "reference/arithmetic.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/profile.hpp"
#include "reference/portable.hpp"

namespace lockstep {

/// Every arithmetic of arithmetic.hpp as one type, chosen at run time: its bits, for what is compiled once and is not a
/// pass's own loop.
using PlainArithmetic = OwnOrders;

/// As with_arithmetic, with two types for all: PlainArithmetic and Portable.
template <class Pass>
decltype(auto) with_plain_arithmetic(const Profile& profile, ArithmeticSwitch arithmetic, Pass&& pass) {
    if (arithmetic == ArithmeticSwitch::exact)
        return pass(Portable{});
    return pass(PlainArithmetic(profile));
}

} // namespace lockstep
