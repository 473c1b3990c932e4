#!/usr/bin/env bash
# One hash on every driver: runs preset exact, free, 1,000 frames of 200,000 particles, on the reference of three
# compilers and on every Mesa driver at hand, and holds each frame's hash against data/results/exact/SCENE.txt.
# Usage: scripts/exact_hashes.sh [CONTEXT...]      contexts beside Mesa's, e.g. egl-device:0
# In the environment: JOBS runs at once; SOFTPIPE_FRAMES, softpipe is slow; LOCKSTEP_BUILDS, a folder with gcc-O0,
# gcc-O3 and clang-O2 built already; LOCKSTEP_SCENES, another folder of scenes.
set -euo pipefail
cd "$(dirname "$0")/.."
export LOCKSTEP_BUILDS=${LOCKSTEP_BUILDS:-build/exact} LOCKSTEP_SCENES=${LOCKSTEP_SCENES:-data/scenes}

build() { # build VARIANT COMPILER
    [ -x "$LOCKSTEP_BUILDS/$1/crosscheck/lockstep" ] && return
    cmake -S . -B "$LOCKSTEP_BUILDS/$1" -G Ninja -DLOCKSTEP_BUILD_TESTS=OFF -DCMAKE_BUILD_TYPE=None \
        "-DCMAKE_CXX_COMPILER=$2" "-DCMAKE_CXX_FLAGS=-${1#*-}" >/dev/null
    cmake --build "$LOCKSTEP_BUILDS/$1" --target lockstep >/dev/null
}

# One run: SCENE FRAMES VARIANT reference THREADS, or SCENE FRAMES VARIANT CONTEXT [NAME=VALUE...]
if [ "${1:-}" = --one ]; then
    scene=$2 frames=$3 variant=$4 side=$5
    shift 5
    hashes=$(mktemp)
    trap 'rm -f "$hashes" "$hashes.both"' EXIT
    run=("$LOCKSTEP_SCENES/$scene.json" --preset exact --particles 200000 --frames "$frames"
        --set obstacles_in_cdt=vertices)
    program=$LOCKSTEP_BUILDS/$variant/crosscheck/lockstep
    if [ "$side" = reference ]; then
        name="reference, $variant, threads $1"
        "$program" hash "${run[@]}" --threads "$1" --every >"$hashes"
    else
        name="GL, $side $*"
        env "$@" "$program" check "${run[@]}" --mode free --gl "$side" --hashes "$hashes.both" --quiet || true
        cut -d' ' -f1,3 "$hashes.both" >"$hashes"
    fi
    if difference=$(cmp "$hashes" <(head -n "$frames" "data/results/exact/$scene.txt") 2>&1); then
        printf '%-8s %-52s %4d frames  %s  equal\n' "$scene" "$name" "$frames" "$(tail -n1 "$hashes" | cut -d' ' -f2)"
    else
        printf '%-8s %-52s DIFFERS: %s\n' "$scene" "$name" "${difference##*: }"
        exit 1
    fi
    exit
fi

build gcc-O0 g++
build gcc-O3 g++
build clang-O2 clang++
for scene in lattice bunny_b; do
    for variant in gcc-O0 gcc-O3 clang-O2; do
        for threads in 1 2; do echo "$scene 1000 $variant reference $threads"; done
    done
    for context in egl "$@"; do echo "$scene 1000 gcc-O3 $context"; done
    for driver in LP_NUM_THREADS=2 GALLIUM_OVERRIDE_CPU_CAPS=sse4.1 LP_NATIVE_VECTOR_WIDTH={128,512}; do
        echo "$scene 1000 gcc-O3 osmesa $driver"
    done
    echo "$scene ${SOFTPIPE_FRAMES:-20} gcc-O3 egl GALLIUM_DRIVER=softpipe"
done | xargs -P "${JOBS:-1}" -L1 "$0" --one
