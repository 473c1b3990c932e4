#!/usr/bin/env bash
# Two scenes in WebGL2, on SwiftShader and on llvmpipe, judged like any run; leaves the verdicts in data/results/webgl/.
# Usage: scripts/webgl_results.sh LOCKSTEP-PROGRAM [BACKEND...]
set -euo pipefail
cd "$(dirname "$0")/.."
lockstep=$(realpath "$1")
shift
results=data/results/webgl
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
declare -A profile=([swiftshader]=swiftshader [gl-egl]=llvmpipe)

for scene in lattice x_streams; do
    "$lockstep" check data/scenes/$scene.json --preset exact --frames 30 --gl osmesa --report "$work/$scene" --quiet
    for backend in "${@:-swiftshader}"; do
        for preset in exact corrected paper; do
            driver=${profile[$backend]}
            name=${driver}_${scene}_$preset
            scripts/save_states.mjs "$work/$scene/report.html" $preset "$work/$name.gz" "$backend"
            scripts/trace_of_states.py "$work/$name.gz" "$work/$name.h5" $results/$driver.json
            # Status 1, a divergence, is a result like any other.
            (cd "$work" && "$lockstep" check --trace $name.h5 || [ $? = 1 ]) | grep -v '^time' >$results/$name.txt
            grep '^verdict' $results/$name.txt
            rm "$work/$name".*
        done
    done
done
