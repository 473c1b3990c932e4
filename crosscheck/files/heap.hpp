#pragma once

namespace lockstep {

/// From now on what is freed of large arrays goes back to the system at once: states of millions of particles come and
/// go, and a C library that keeps their memory for later holds more than any moment needs. Does nothing where the C
/// library has no such setting.
void give_back_large_arrays();

} // namespace lockstep
