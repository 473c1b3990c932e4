#!/usr/bin/env bash
# Builds the program with the address and the undefined-behaviour sanitizer, runs every verb on every system for every
# verdict class and output (tests/matrix/), and then each fuzzer. Without optimisation: the passes' templates compile
# in a third of the time, and the matrix's scenes are small.
# Usage: scripts/sanitize.sh [--short] [SECONDS]      SECONDS: of each fuzzer; default 60
#   --short    all verbs for the cases named divergent alone, `check` with every output for all (run_matrix.py)
set -euo pipefail
cd "$(dirname "$0")/.."
short=()
if [ "${1:-}" = --short ]; then short=(--short) && shift; fi
scripts/install_packages.sh --for sanitize
scripts/build_report_page.sh > /dev/null
cmake --preset sanitize > /dev/null
cmake --build --preset sanitize --target lockstep
tests/matrix/run_matrix.py build/sanitize/crosscheck/lockstep "${short[@]}"
scripts/fuzz.sh "${1:-60}"
