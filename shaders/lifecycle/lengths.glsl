// Sums of distances: by blocks of floats, or in 2^-16 units without rounding. Twin: reference/lifecycle/lengths.hpp.
#if DISTANCE_SUM == DISTANCE_SUM_FIXED
#define Length uint
Length plus(Length a, Length b) { return a + b; }
Length length_of(float distance) {
    float units = floor(add(mul(distance, 65536.0), 0.5));
    return units > 0.0 ? (units < 2147483648.0 ? uint(units) : 0x80000000u) : 0u;
}
float distance_of(Length sum) { return add(float(sum >> 16), mul(float(sum & 0xffffu), 1.0 / 65536.0)); }
#define NO_LENGTH 0u
#else
#define Length float
Length plus(Length a, Length b) { return add(a, b); }
Length length_of(float distance) { return distance; }
float distance_of(Length sum) { return sum; }
#define NO_LENGTH 0.0
#endif
