// Hillis and Steele's inclusive scan of a group of 256: for d = 1, 2, .. 128: x_i = x_(i - d) + x_i.
shared Length partial[256];

Length length_scan(Length x) {
    uint i = gl_LocalInvocationID.x;
    partial[i] = x;
    barrier();
    for (uint d = 1u; d < 256u; d <<= 1) {
        Length sum = i >= d ? plus(partial[i - d], partial[i]) : partial[i];
        barrier();
        partial[i] = sum;
        barrier();
    }
    return partial[i];
}
