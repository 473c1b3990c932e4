#pragma once

namespace lockstep {

/// From now on what is freed of arrays of more than 16 MiB goes back to the system at once: states of millions of
/// particles come and go, and a C library that keeps their memory for later holds more than any moment needs. Smaller
/// ones are kept, as a frame soon asks for as many again. Does nothing where the C library has no such setting.
void give_back_large_arrays();

} // namespace lockstep
