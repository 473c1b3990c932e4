#!/usr/bin/env bash
# Checks that the sources of each library compile as one, as the release preset has them in parts: no two of them may give
# one name to different things.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/unity
cmake --preset release -B "$build" -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 > /dev/null
ninja -C "$build" -t compdb | python3 -c '
import json, shlex, sys
for entry in json.load(sys.stdin):
    words = shlex.split(entry["command"]) if "/Unity/" in entry["file"] else []
    if "-o" in words:
        at = words.index("-o")
        print(shlex.join(words[:at] + words[at + 2:] + ["-fsyntax-only"]))
' | (cd "$build" && xargs -P "$(nproc)" -d '\n' -n 1 bash -c 'eval "$0"')
echo "the sources of each library compile as one"
