#!/usr/bin/env bash
# Fails where clang-tidy 14 (Debian 12's) has something to say; newer ones have more to say. Needs a build folder with
# compile_commands.json (any preset).
# Usage: scripts/check_tidy.sh [BUILD-FOLDER]      default: build/ci
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/ci}
git ls-files 'reference/*.cpp' 'gpu/*.cpp' 'crosscheck/*.cpp' | xargs -P 2 -n 4 clang-tidy --quiet -p "$build"
