#!/usr/bin/env bash
# Builds the program with the address and the undefined-behaviour sanitizer, runs every verb on every system for every
# verdict class and output (tests/matrix/), and then each fuzzer.
# Usage: scripts/sanitize.sh [SECONDS]      of each fuzzer; default 60
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh --for sanitize
scripts/build_report_page.sh > /dev/null
cmake --preset sanitize -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 \
    -DLOCKSTEP_BUILD_TESTS=OFF > /dev/null
cmake --build build/sanitize --target lockstep
tests/matrix/run_matrix.py build/sanitize/crosscheck/lockstep
scripts/fuzz.sh "${1:-60}"
