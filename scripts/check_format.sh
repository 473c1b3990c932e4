#!/usr/bin/env bash
# Fails where clang-format (14) would change a source file.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror
