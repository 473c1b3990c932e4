#!/usr/bin/env bash
# Builds targets with Clang's address and undefined-behaviour sanitizers into build/sanitized, many sources as one.
# Usage: scripts/sanitized_build.sh TARGET...
set -euo pipefail
cd "$(dirname "$0")/.."
cmake -S . -B build/sanitized -G Ninja -DCMAKE_CXX_COMPILER=clang++-19 -DCMAKE_BUILD_TYPE=Release -DLOCKSTEP_FUZZ=ON \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1 -fno-omit-frame-pointer" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 \
    -DLOCKSTEP_BUILD_TESTS=OFF > /dev/null
cmake --build build/sanitized --target "$@"
