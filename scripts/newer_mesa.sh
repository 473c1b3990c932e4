#!/usr/bin/env bash
# The shipped shaders on Debian 13's Mesa, OSMesa and EGL: two scenes in three presets, small. Its root is kept in the
# system's cache folder, or $LOCKSTEP_CACHE. Where it cannot be made, that is a failure with CI=true, else a skip.
# Usage: scripts/newer_mesa.sh [BUILD]      a build folder with the program; otherwise build/ci
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/ci}
[ -e "$build/CMakeCache.txt" ] || { echo "newer_mesa: $build is no build folder" >&2; exit 2; }
cache=${LOCKSTEP_CACHE:-/var/cache/lockstep}
cannot() {
    if [ "${CI:-}" = true ]; then echo "newer_mesa: $*" >&2; exit 2; fi
    echo "newer_mesa: skipped: $*"
    exit 0
}
[ "$(id -u)" = 0 ] || cannot "a root with Debian 13's Mesa needs root"
mkdir -p "$cache" 2>/dev/null && [ -w "$cache" ] || cannot "$cache cannot be written"
scripts/mesa_root.sh trixie "$cache/mesa-trixie" || cannot "there is no root with Debian 13's Mesa; the reason is above"
scripts/driver_matrix.sh "$cache" --work "$build/newer_mesa" --results "$build/newer_mesa" --build "$build" \
    --only trixie-osmesa,trixie-egl --scene lattice,x_streams --particles 2000 --frames 10
