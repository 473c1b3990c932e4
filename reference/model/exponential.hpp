#pragma once

namespace lockstep {

/// e^x of x from -87 to 0 by + - * alone, in this order, so that no library decides: reduced by a power of two in two
/// parts, then a polynomial of degree 6: the nearest float, or one beside it. `floor(x)`; `scaled(p, j)`: p 2^j, exact.
/// Number: a float, or what a reading takes for one.
template <class Number, class Floor, class Scaled>
Number exponential(const Number& x, const Floor& floor, const Scaled& scaled) {
    const Number j = floor(x * Number(1.44269504F) + Number(0.5F));
    const Number q = (x - j * Number(0.693359375F)) - j * Number(-2.12194440e-4F);
    Number p(0.0013941169F);
    for (const float coefficient : {0.00837517437F, 0.0416663513F, 0.166664153F, 0.5F, 1.0F, 1.0F})
        p = p * q + Number(coefficient);
    return scaled(p, j);
}

/// Below this the exponential counts as 0.
inline constexpr float least_exponent = -87.0F;

} // namespace lockstep
