#!/usr/bin/env bash
# Runs libFuzzer over the readers of scenes, capsules and traces, from the corpus in tests/fuzz/corpus. Needs clang and
# its runtime (scripts/install_packages.sh --for sanitize). Usage: scripts/fuzz.sh [SECONDS]      for each reader; default 200
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-200}
cmake --preset sanitize > /dev/null
cmake --build --preset sanitize --target lockstep_fuzz_scene lockstep_fuzz_capsule lockstep_fuzz_messages > /dev/null
fuzz() {
    reader=$1 found=build/sanitize/found/$1
    rm -rf "$found" # a crash that was mended is no failure
    mkdir -p "$found"
    # rss: a message may ask for as much as its limits allow.
    nice -n 19 "build/sanitize/tests/fuzz/lockstep_fuzz_$reader" -max_total_time="$seconds" -rss_limit_mb=4096 \
        -malloc_limit_mb=3500 -timeout=20 -print_final_stats=1 -artifact_prefix="$found/crash-" "$found" \
        "tests/fuzz/corpus/$reader" 2>&1 | grep -E "^(stat::number|SUMMARY|==)|Test unit" | sed "s/^/$reader: /" || true
    ! ls "$found"/crash-* > /dev/null 2>&1 || { echo "fuzz: $reader breaks on $found/crash-*" >&2; return 1; }
    [ -n "$(ls "$found")" ] || { echo "fuzz: $reader found no input of its own" >&2; return 1; }
}
# Two at a time, as many as CI has cores.
fuzz scene & first=$!
fuzz capsule & second=$!
status=0
wait "$first" || status=1
wait "$second" || status=1
fuzz messages || status=1
exit "$status"
