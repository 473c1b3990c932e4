#!/usr/bin/env bash
# Builds the program and the fuzzers with the address and the undefined-behaviour sanitizer, runs every verb on every system
# for every verdict class and output (tests/matrix/), and then each fuzzer.
# Usage: scripts/sanitize.sh [SECONDS]      of each fuzzer; default 60
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh --for sanitize
scripts/build_report_page.sh > /dev/null
scripts/sanitized_build.sh lockstep
tests/matrix/run_matrix.py build/sanitized/crosscheck/lockstep
scripts/fuzz.sh "${1:-60}"
