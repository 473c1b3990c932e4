// Times of the particle at hand in seconds, whatever its layout counts. Twin: reference/lifecycle/graphs.hpp.
float in_seconds(float t) {
#if TICKS
    return mul(t, u_Tick);
#else
    return t;
#endif
}
