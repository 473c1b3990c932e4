#!/usr/bin/env bash
# Writes data/golden/SCENE.json: the reference's state hash of every shipped scene. They change only when the algorithm
# or a scene does; tests/collision/golden_hash_test.cpp holds them.
# Usage: scripts/golden_hashes.sh LOCKSTEP [SCENE.json ...]
set -euo pipefail
cd "$(dirname "$0")/.."
lockstep=$1
shift
[ $# -gt 0 ] || set -- data/scenes/*.json
frames=30
particles=5000

mkdir -p data/golden
for scene in "$@"; do
    text=""
    for preset in paper corrected exact; do
        hashes=""
        for profile in strict llvmpipe; do
            line=$("$lockstep" hash "$scene" --frames $frames --particles $particles --preset $preset --profile $profile)
            hashes+="${hashes:+, }\"$profile\": \"${line#* }\""
        done
        text+="${text:+,$'\n'}    \"$preset\": { $hashes }"
    done
    printf '{\n  "frames": %d,\n  "particles": %d,\n  "hashes": {\n%s\n  }\n}\n' $frames $particles "$text" \
        > "data/golden/$(basename "$scene")"
done
