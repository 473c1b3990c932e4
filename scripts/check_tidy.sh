#!/usr/bin/env bash
# Fails where clang-tidy has something to say (14 lacks std::source_location: 19 is used where it is there). Needs a build
# folder with compile_commands.json (any preset).
# Usage: scripts/check_tidy.sh [--changed] [BUILD]
#   --changed  only lines that the newest commit changed, and those before it within a day of it as long as these are
#              lines of at most 24 files, each of which takes half a minute
#   BUILD      a build folder; otherwise build/ci
set -euo pipefail
cd "$(dirname "$0")/.."
changed=
if [ "${1:-}" = --changed ]; then changed=1 && shift; fi
build=${1:-build/ci}
most=24
tidy=$(command -v clang-tidy-19 || echo clang-tidy)
[ -e "$build/compile_commands.json" ] || { echo "check_tidy: $build has no compile_commands.json" >&2; exit 2; }
if [ -z "$changed" ]; then
    git ls-files 'reference/*.cpp' 'gpu/*.cpp' 'crosscheck/*.cpp' | xargs -P "$(nproc)" -n 4 "$tidy" --quiet -p "$build"
    exit
fi
diff=$(ls /usr/bin/clang-tidy-diff-*.py | sort -V | tail -1)
paths=('reference/*.[ch]pp' 'gpu/*.[ch]pp' 'crosscheck/*.[ch]pp')
day_before=$(($(git log -1 --format=%ct) - 86400))
base=
for older in $(git rev-list --first-parent --max-count=200 HEAD~1 2> /dev/null); do # the newest commit counts always
    files=$(git diff --name-only --diff-filter=ACMR "$older" HEAD -- "${paths[@]}" | wc -l)
    if [ -n "$base" ] && { [ "$files" -gt "$most" ] || [ "$(git log -1 --format=%ct "$older")" -lt "$day_before" ]; }; then break; fi
    base=$older
done
[ -n "$base" ] || { echo "check_tidy: there is no older commit"; exit 0; }
found=$(git diff -U0 "$base" -- "${paths[@]}" |
    "$diff" -p1 -clang-tidy-binary "$tidy" -path "$build" -j "$(nproc)" -quiet 2>&1 | grep -vE '^[0-9]+ warnings? generated|^$' || true)
if grep -qE ': (warning|error): ' <<< "$found"; then
    printf '%s\n' "$found" >&2
    exit 1
fi
echo "clang-tidy has nothing to say about what changed since $(git rev-parse --short "$base")"
