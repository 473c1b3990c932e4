#!/usr/bin/env bash
# Runs libFuzzer over the readers of scenes, capsules and traces, from the corpus in tests/fuzz/corpus. Needs clang and
# its runtime (scripts/install_packages.sh --for sanitize). Usage: scripts/fuzz.sh [SECONDS]      for each reader; default 200
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-200}
cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++-19 -DCMAKE_BUILD_TYPE=Release -DLOCKSTEP_FUZZ=ON \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1 -fno-omit-frame-pointer" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 \
    -DLOCKSTEP_BUILD_TESTS=OFF -DLOCKSTEP_SYSTEMS= > /dev/null # the readers know the collision system alone
cmake --build build/fuzz --target lockstep_fuzz_scene lockstep_fuzz_capsule lockstep_fuzz_messages > /dev/null
fuzz() {
    reader=$1 found=build/fuzz/found/$1
    rm -rf "$found" # a crash that was mended is no failure
    mkdir -p "$found"
    # rss: a message may ask for as much as its limits allow.
    nice -n 19 "build/fuzz/tests/fuzz/lockstep_fuzz_$reader" -max_total_time="$seconds" -rss_limit_mb=4096 \
        -malloc_limit_mb=3500 -timeout=20 -print_final_stats=1 -artifact_prefix="$found/crash-" "$found" \
        "tests/fuzz/corpus/$reader" 2>&1 | grep -E "^(stat::number|SUMMARY|==)|Test unit" | sed "s/^/$reader: /" || true
    ! ls "$found"/crash-* > /dev/null 2>&1 || { echo "fuzz: $reader breaks on $found/crash-*" >&2; return 1; }
    ls "$found" | grep -q . || { echo "fuzz: $reader found no input of its own" >&2; return 1; }
}
# Two at a time, as many as CI has cores.
fuzz scene & first=$!
fuzz capsule & second=$!
status=0
wait "$first" || status=1
wait "$second" || status=1
fuzz messages || status=1
exit "$status"
