#pragma once

namespace lockstep::probing {

/// On the grid of halves with no largest value: 2^-10 of the power of two below, 2^-24 for subnormals. `round`: of a
/// number of such units.
float on_half_grid(float x, double (*round)(double));

double nearest_even(double x);
double nearest_away(double x);
double toward_zero(double x);

} // namespace lockstep::probing
