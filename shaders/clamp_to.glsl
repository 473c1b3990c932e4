// To 0..high; NaN becomes 0.
float clamp_to(float x, float high) { return x > 0.0 ? (x < high ? x : high) : 0.0; }
