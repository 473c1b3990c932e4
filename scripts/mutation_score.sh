#!/usr/bin/env bash
# Runs the whole catalogue of mutants (tests/mutants) on OSMesa and writes data/results/mutants/llvmpipe.json and
# data/results/mutants/mutants.md. Takes some minutes. Status 0 if every mutant is found and the causes are named.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release -DLOCKSTEP_BUILD_TESTS=ON
cmake --build --preset release --target lockstep_mutants
mkdir -p data/results/mutants
build/release/tests/mutants/lockstep_mutants --jobs "$(nproc)" --commit "$(git rev-parse --short HEAD)" \
  --json data/results/mutants/llvmpipe.json --markdown data/results/mutants/mutants.md
