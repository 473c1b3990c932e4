#!/usr/bin/env bash
# Runs the shipped shaders on the Mesa drivers of Debian 12, 13 and sid: every scene in three presets, and the mutants.
# Writes data/results/drivers/DRIVER.json and a table. Runs that this commit has done are not done again.
# Usage: scripts/driver_matrix.sh ROOTS [OPTION...]
#   ROOTS              folder for the releases' roots (1.5 GB each, scripts/mesa_root.sh)
#   --work DIR         for the program and what has been run; otherwise ROOTS
#   --only A,B         drivers: SUITE-KIND, e.g. trixie-osmesa, or SUITE. SUITE is bookworm, trixie, sid, or here for this
#                      machine's Mesa; KIND is osmesa, egl (both llvmpipe), softpipe, zink (on lavapipe)
#   --scene A,B        scenes, by name; --preset A,B the same of paper, corrected, exact
#   --particles N, --frames N   otherwise 20,000 x 30; on zink 5,000 x 10, on softpipe 500 x 3
#   --mutants          the catalogue of mutants on each driver, too
#   --results DIR      instead of data/results/drivers
#   --build DIR        a build folder to take the program from; otherwise build/release, which is made
# Exit status: 0 nothing is divergent, 1 something is, 2 something could not be run.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "driver_matrix: $*" >&2; exit 2; }

drivers=({bookworm,trixie}-{osmesa,egl,softpipe,zink} sid-{egl,softpipe,zink})
here=(here-{osmesa,egl,softpipe,zink})
presets=(paper corrected exact)
only='' work='' scenes='' particles='' frames='' mutants='' results=data/results/drivers build=build/release
[ $# -gt 0 ] && [[ $1 != --* ]] || { sed -n '/^# Usage/,/^# Exit/p' "$0" | cut -c3- >&2; exit 2; }
roots=$1
shift
while [ $# -gt 0 ]; do
    [ "$1" = --mutants ] && { mutants=yes; shift; continue; }
    [ $# -ge 2 ] || fail "$1 needs a value, or is not an option"
    case $1 in
    --only) only=$2 ;;
    --work) work=$2 ;;
    --scene) scenes=${2//,/ } ;;
    --preset) IFS=, read -ra presets <<<"$2" ;;
    --particles) particles=$2 ;;
    --frames) frames=$2 ;;
    --results) results=$2 ;;
    --build) build=$2 ;;
    *) fail "$1 is not an option; --only, --work, --scene, --preset, --particles, --frames, --mutants, --results, --build are" ;;
    esac
    shift 2
done

# The drivers that are asked for, in the table's order.
chosen=()
if [ -z "$only" ]; then chosen=("${drivers[@]}"); fi
for name in ${only//,/ }; do
    found=''
    for driver in "${drivers[@]}" "${here[@]}"; do
        if [ "$driver" = "$name" ] || [ "${driver%-*}" = "$name" ]; then chosen+=("$driver") found=yes; fi
    done
    [ -n "$found" ] || fail "no driver is named $name; there are ${drivers[*]} ${here[*]}"
done
for preset in "${presets[@]}"; do
    case $preset in paper | corrected | exact) ;; *) fail "no preset is named $preset; there are paper, corrected, exact" ;; esac
done
all_scenes=$(cd data/scenes && ls -- *.json catalogue/*.json | sed 's/\.json$//')
for scene in $scenes; do
    grep -qxE "(catalogue/)?$scene" <<<"$all_scenes" || fail "no scene is named $scene; there are" $all_scenes
done
case "${chosen[*]}" in *bookworm* | *trixie* | *sid*) [ "$(id -u)" = 0 ] || fail "the releases' roots need root; --only here does not" ;; esac

[ "$build" = build/release ] || [ -e "$build/CMakeCache.txt" ] || fail "$build is no build folder"

mkdir -p "$roots" "${work:=$roots}"
roots=$(cd "$roots" && pwd) work=$(cd "$work" && pwd)
commit=$(git describe --always --dirty --abbrev=7 2>/dev/null || echo unknown)
program=$work/program-$commit runs=$work/runs-$commit
if [[ $commit == *-dirty || $commit == unknown ]]; then rm -rf "$program" "$runs"; fi
if [ ! -x "$program/bin/lockstep" ]; then scripts/portable_folder.sh "$program" "$build"; fi
if [ -n "$mutants" ]; then
    cmake -DLOCKSTEP_BUILD_TESTS=ON "$build" >/dev/null
    cmake --build "$build" --target lockstep_mutants >/dev/null
fi
mkdir -p "$runs" "$results"

# on DRIVER COMMAND...: in its root, with the program at /lockstep and the runs' folder at /runs; `here`, as they are.
on() {
    local suite=${1%-*} kind=${1#*-} settings=(LIBGL_ALWAYS_SOFTWARE=1 OMP_WAIT_POLICY=passive)
    shift
    case $kind in
    softpipe) settings+=(GALLIUM_DRIVER=softpipe) ;;
    zink) settings+=(MESA_LOADER_DRIVER_OVERRIDE=zink) ;;
    *) settings+=(GALLIUM_DRIVER=llvmpipe) ;;
    esac
    if [ "$suite" = here ]; then env "${settings[@]}" "$@"; return; fi
    scripts/mesa_root.sh "$suite" "$roots/mesa-$suite" --bind "$program" /lockstep --bind "$runs" /runs --bind "$PWD" "$PWD" \
        /usr/bin/env "${settings[@]}" "$@"
}
context_of() { [ "${1#*-}" = osmesa ] && echo osmesa || echo egl; }
renderer_of() { case ${1#*-} in osmesa | egl) echo llvmpipe ;; *) echo "${1#*-}" ;; esac; }

# run DRIVER SCENE PRESET: the report as JSON in the runs' folder, or why there is none, and the exit status.
run() {
    local driver=$1 scene=$2 preset=$3 folder=/lockstep out=/runs count=20000 length=30
    case $driver in *-softpipe) count=500 length=3 ;; *-zink) count=5000 length=10 ;; esac
    if [ "${driver%-*}" = here ]; then folder=$program out=$runs; fi
    local size=(--particles "${particles:-$count}" --frames "${frames:-$length}")
    local name=$driver/${scene//\//.}.$preset.${size[1]}x${size[3]}
    [ ! -s "$runs/$name.status" ] || { echo "$name"; return; }
    mkdir -p "$runs/$driver"
    local mesh mode=resync status=0
    mesh=$(sed -n 's/.*"file": "\.\.\/\(meshes[^"]*\)".*/\1/p' "data/scenes/$scene.json" | head -n 1)
    if [ -n "$mesh" ] && [ ! -e "data/$mesh" ]; then
        echo "skipped: data/$mesh is missing; scripts/fetch_meshes.sh" >"$runs/$name.error"
        echo "$name"
        return
    fi
    [ "$preset" != exact ] || mode=free
    rm -f "$runs/$name.json"
    on "$driver" timeout 900 "$folder/bin/lockstep" check "$folder/share/lockstep/scenes/$scene.json" --preset "$preset" --mode $mode \
        "${size[@]}" --gl "$(context_of "$driver")" --json "$out/$name.json" --quiet >/dev/null 2>"$runs/$name.error" || status=$?
    echo $status >"$runs/$name.status"
    echo "$name"
}

for driver in "${chosen[@]}"; do
    done=()
    if [ "${driver%-*}" != here ]; then scripts/mesa_root.sh "${driver%-*}" "$roots/mesa-${driver%-*}"; fi
    for scene in ${scenes:-$all_scenes}; do
        [ -e "data/scenes/$scene.json" ] || scene=catalogue/$scene
        for preset in "${presets[@]}"; do done+=("$(run "$driver" "$scene" "$preset")"); done
    done
    if [ -n "$mutants" ]; then
        score=$runs/$driver/mutants.json
        libraries=/lockstep/lib out=/runs/$driver/mutants.json
        if [ "${driver%-*}" = here ]; then libraries=$program/lib out=$score; fi
        # The catalogue is read from the source tree, which is at the same place in the root.
        [ -s "$score" ] || on "$driver" sh -c 'cd "$1" && LD_LIBRARY_PATH=$2 && export LD_LIBRARY_PATH && shift 2 && exec "$@"' sh \
            "$PWD" "$libraries" "$build/tests/mutants/lockstep_mutants" \
            --gl "$(context_of "$driver")" --commit "$commit" --json "$out" >"$runs/$driver/mutants.txt" 2>&1 || true
    fi
    scripts/driver_results.py add "$results/$driver.json" --driver "$driver" --renderer "$(renderer_of "$driver")" \
        --commit "$commit" --runs "$runs" ${mutants:+--mutants "$runs/$driver/mutants"} --run "${done[@]}"
done
scripts/driver_results.py table "$results" --commit "$commit" --driver "${chosen[@]}"
