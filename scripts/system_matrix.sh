#!/usr/bin/env bash
# Runs the scenes of a system in three presets on the Mesa drivers of this machine and of Debian 13 and sid, and prints a
# table: the verdict of each, and in preset exact, run free, the hash.
# Usage: scripts/system_matrix.sh SYSTEM ROOTS [BUILD]
#   SYSTEM  a folder of data/scenes; ROOTS a folder for the releases' roots (scripts/mesa_root.sh); BUILD a build folder with
#           the program, otherwise build/ci
# DRIVERS="here-osmesa sid-egl", PARTICLES, FRAMES, SCENES="a b" in the environment choose others.
# Exit status: 0 nothing is divergent, 1 something is, 2 something could not be run.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "system_matrix: $*" >&2; exit 2; }
[ $# -ge 2 ] || { sed -n 4p "$0" | cut -c3- >&2; exit 2; }
system=$1 build=${3:-build/ci}
[ -d "data/scenes/$system" ] || fail "data/scenes has no folder $system"
[ -e "$build/CMakeCache.txt" ] || fail "$build is no build folder"
mkdir -p "$2"
roots=$(cd "$2" && pwd)
program=$roots/program
scripts/portable_folder.sh "$program" "$build" >&2
scenes=${SCENES:-$(cd "data/scenes/$system" && ls -- *.json | sed 's/\.json$//')}
worst=0

# on DRIVER COMMAND...: in its root, or here.
on() {
    local suite=${1%-*} kind=${1#*-} settings=(LIBGL_ALWAYS_SOFTWARE=1 OMP_WAIT_POLICY=passive GALLIUM_DRIVER=llvmpipe)
    if [ "$kind" = softpipe ]; then settings+=(GALLIUM_DRIVER=softpipe); fi
    shift
    if [ "$suite" = here ]; then env "${settings[@]}" "$@"; return; fi
    scripts/mesa_root.sh "$suite" "$roots/mesa-$suite" --bind "$program" "$program" /usr/bin/env "${settings[@]}" "$@"
}

printf '# scripts/system_matrix.sh %s, %s lights or items, %s frames, at %s\n' "$system" "${PARTICLES:-512}" "${FRAMES:-3}" \
    "$(git describe --always --dirty --abbrev=7)"
for driver in ${DRIVERS:-here-osmesa trixie-osmesa trixie-egl sid-egl}; do
    gl=egl
    if [ "${driver#*-}" = osmesa ]; then gl=osmesa; fi
    printf '\n%s: %s\n' "$driver" "$(on "$driver" "$program/bin/lockstep" info --gl $gl 2>/dev/null | sed -n 's/^GL *//p;s/^context *//p' | head -1)"
    for scene in $scenes; do
        for preset in paper corrected exact; do
            mode=resync status=0
            if [ "$preset" = exact ]; then mode=free; fi
            report=$(on "$driver" timeout 900 "$program/bin/lockstep" check "$program/share/lockstep/scenes/$system/$scene.json" \
                --preset $preset --mode $mode --particles "${PARTICLES:-512}" --frames "${FRAMES:-3}" --gl $gl 2>&1) || status=$?
            if [ $status -gt $worst ]; then worst=$status; fi
            verdict=$(sed -n 's/^verdict *//p' <<<"$report")
            hash=$(sed -n 's/^hash *//p' <<<"$report")
            if [ "$preset" != exact ]; then hash=''; fi
            printf '%-18s %-10s %s%s\n' "$scene" "$preset" "${verdict:-$(tail -n 1 <<<"$report")}" "${hash:+; $hash}"
        done
    done
done
exit $worst
