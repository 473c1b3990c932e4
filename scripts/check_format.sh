#!/usr/bin/env bash
# Fails where clang-format (14) would change a source file.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-format >/dev/null || { echo "check_format: clang-format is missing; apt-get install clang-format" >&2; exit 2; }
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror
