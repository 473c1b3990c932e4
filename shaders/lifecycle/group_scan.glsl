// The exclusive prefix sum of a number a thread, over a group of 256; `total` is that of all.
shared uint scanned[256];

uint group_scan(uint x, out uint total) {
    uint i = gl_LocalInvocationID.x;
    scanned[i] = x;
    barrier();
    for (uint d = 1u; d < 256u; d <<= 1) {
        uint left = i >= d ? scanned[i - d] : 0u;
        barrier();
        scanned[i] += left;
        barrier();
    }
    total = scanned[255];
    uint before_it = i == 0u ? 0u : scanned[i - 1u];
    barrier();
    return before_it;
}
