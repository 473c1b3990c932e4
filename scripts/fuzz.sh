#!/usr/bin/env bash
# Runs libFuzzer over the readers of scenes, capsules and traces, from the corpus in tests/fuzz/corpus. Needs clang and
# libclang-rt-14-dev. Usage: scripts/fuzz.sh [SECONDS]      for each reader; default 200
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-200}
cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DLOCKSTEP_FUZZ=ON \
    -DLOCKSTEP_BUILD_TESTS=OFF >/dev/null
cmake --build build/fuzz --target lockstep_fuzz_scene lockstep_fuzz_capsule lockstep_fuzz_messages >/dev/null
for reader in scene capsule messages; do
    found=build/fuzz/found/$reader
    mkdir -p "$found"
    # rss: a message may ask for as much as its limits allow.
    nice -n 19 "build/fuzz/tests/fuzz/lockstep_fuzz_$reader" -max_total_time="$seconds" -rss_limit_mb=4096 \
        -malloc_limit_mb=3500 -timeout=20 -print_final_stats=1 -artifact_prefix="$found/crash-" "$found" \
        "tests/fuzz/corpus/$reader" 2>&1 | grep -E "^(stat|SUMMARY|==)|Test unit" || true
    ! ls "$found"/crash-* >/dev/null 2>&1 || { echo "fuzz: $reader breaks on $found/crash-*" >&2; exit 1; }
done
