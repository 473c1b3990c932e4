#!/usr/bin/env bash
# How long the first steps take on this machine, as a table: the first verdict, a shader of one's own, a system of one's own.
# On an empty Debian that counts installing and compiling, which needs root or sudo; after scripts/demo.sh what is there
# already. No time to read, think or type is in it.
# Usage: scripts/stopwatch.sh
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
program=$PWD/build/release/crosscheck/lockstep

fail() { printf 'stopwatch: %s\n' "$1" >&2; tail -20 "$work/out" >&2; exit 1; }
# ends_with STATUS TEXT COMMAND...: as it should.
ends_with() {
    local expected=$1 text=$2 status=0
    shift 2
    "$@" >"$work/out" 2>&1 || status=$?
    [ "$status" = "$expected" ] || fail "status $status, not $expected: $*"
    grep -qF -- "$text" "$work/out" || fail "'$text' is not said by: $*"
}
row() { printf '| %s | %d min %02d s |\n' "$1" $(($2 / 60)) $(($2 % 60)); }

ends_with 0 "The first verdict came after" scripts/demo.sh
whole=$SECONDS
first=$(sed -n 's/The first verdict came after \([0-9]*\) min \([0-9]*\) s.*/\1 \2/p' "$work/out")

SECONDS=0 # docs/own_shader.md
mkdir "$work/mine"
sed 's/ && len < particle_min_length//' shaders/collision/collision_pass.vert >"$work/mine/collision_pass.vert"
ends_with 1 "last_found_instead_of_nearest" "$program" check data/scenes/x_streams.json --shaders "$work/mine" --frames 60
own_shader=$SECONDS

SECONDS=0 # docs/own_system.md
cmake --install build/release --prefix "$work/prefix" >"$work/out" 2>&1 || fail "cmake --install"
cd "$work"
ends_with 0 "sparks" prefix/bin/lockstep new system sparks
ends_with 0 "" cmake -S sparks -B sparks/build "-DCMAKE_PREFIX_PATH=$work/prefix"
ends_with 0 "" cmake --build sparks/build --target sparks
ends_with 1 "DIVERGENT" sparks/build/sparks check
sed -i 's|^        //     |        |' sparks/sparks.hpp # the twin that the skeleton proposes
ends_with 0 "" cmake --build sparks/build --target sparks
ends_with 0 "AGREE" sparks/build/sparks check
sed -i 's/ + u_Gravity \* u_Tick//' sparks/sparks_step.vert
ends_with 1 "gravity_missing" sparks/build/sparks check
own_system=$SECONDS

. /etc/os-release
echo "$PRETTY_NAME, $(nproc) cores"
echo
echo "| from nothing to | |"
echo "|---|---|"
row "the first verdict" $((${first% *} * 60 + ${first#* }))
row "the whole of scripts/demo.sh" "$whole"
echo "| from there to | |"
row "a bug in a shader of one's own, by name" "$own_shader"
row "a system of one's own, and a bug in it by name" "$own_system"
