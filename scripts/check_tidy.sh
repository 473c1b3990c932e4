#!/usr/bin/env bash
# Fails where clang-tidy has something to say (14 lacks std::source_location: 19 is used where it is there). Needs a build
# folder with compile_commands.json (any preset).
# Usage: scripts/check_tidy.sh [--changed] [BUILD]
#   --changed  only lines that changed within a day before the newest commit, or in that commit where history is shorter
#   BUILD      a build folder; otherwise build/ci
set -euo pipefail
cd "$(dirname "$0")/.."
changed=
if [ "${1:-}" = --changed ]; then changed=1 && shift; fi
build=${1:-build/ci}
tidy=$(command -v clang-tidy-19 || echo clang-tidy)
[ -e "$build/compile_commands.json" ] || { echo "check_tidy: $build has no compile_commands.json" >&2; exit 2; }
if [ -z "$changed" ]; then
    git ls-files 'reference/*.cpp' 'gpu/*.cpp' 'crosscheck/*.cpp' | xargs -P "$(nproc)" -n 4 "$tidy" --quiet -p "$build"
    exit
fi
diff=$(ls /usr/bin/clang-tidy-diff-*.py | sort -V | tail -1)
day_before=$(($(git log -1 --format=%ct) - 86400))
base=$(git rev-list -1 --before="$day_before" HEAD)
[ -n "$base" ] || base=$(git rev-parse --verify --quiet HEAD~1) || { echo "check_tidy: there is no older commit"; exit 0; }
found=$(git diff -U0 "$base" -- 'reference/*.[ch]pp' 'gpu/*.[ch]pp' 'crosscheck/*.[ch]pp' |
    "$diff" -p1 -clang-tidy-binary "$tidy" -path "$build" -j "$(nproc)" -quiet 2>&1 | grep -vE '^[0-9]+ warnings? generated|^$' || true)
if grep -qE ': (warning|error): ' <<< "$found"; then
    printf '%s\n' "$found" >&2
    exit 1
fi
echo "clang-tidy has nothing to say about what changed since $(git rev-parse --short "$base")"
