// To 0..high; NaN becomes 0.
float clamp_to(float x, float high) { return x > 0.0 ? (x < high ? x : high) : 0.0; }

// 0 <= x <= 1, not -0. By the bits, since compilers may turn a comparison round and let NaN pass.
bool in_unit_interval(float x) {
    int bits = floatBitsToInt(x);
    return bits >= 0 && bits <= 0x3f800000;
}
