#!/usr/bin/env bash
# scripts/driver_matrix.sh on this machine's Mesa: results and table, what is not run twice, and its exit status where a
# run is divergent, a driver is missing, or nothing is named so.
# Usage: driver_matrix_test.sh SOURCE BUILD KIND     KIND: osmesa or egl; exit status 77: no such GL here
set -euo pipefail
matrix=$1/scripts/driver_matrix.sh build=$2 kind=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { printf 'driver_matrix_test: %s\n' "$1" >&2; cat out.txt >&2; exit 1; }
ends_with() {
    local expected=$1 status=0
    shift
    "$@" >out.txt 2>&1 || status=$?
    [ "$status" = "$expected" ] || fail "status $status, not $expected: $*"
}
says() { grep -qF -- "$1" "${2:-out.txt}" || fail "this is not said: $1"; }
small=("$matrix" "$work/roots" --build "$build" --results "$work/results" --scene lattice --particles 100 --frames 2)

if [ "${LOCKSTEP_REQUIRE_GL:-}" != 1 ] && ! "$build/crosscheck/lockstep" probe --gl "$kind" >out.txt 2>&1; then
    cat out.txt
    exit 77
fi

# One driver.
ends_with 0 "${small[@]}" --only "here-$kind" --preset corrected,exact
says "| here-$kind | llvmpipe ("
says '"verdict": "AGREE"' "results/here-$kind.json"
says "| here-$kind | llvmpipe (" results/README.md
[ "$(grep -c '"size": "100x2"' "results/here-$kind.json")" = 2 ] || fail "not one row a preset"

# A driver that is not there did not run, and one that is another is not taken for it.
ends_with 2 env LOCKSTEP_EGL_LIBRARY=/no/such/libEGL.so "${small[@]}" --only here-softpipe --preset exact
says "here-softpipe lattice exact 100x2: lockstep: no GL context: egl: /no/such/libEGL.so: cannot open"

# Divergent runs: the judge is told by what a run left behind.
results() { "${matrix%/*}/driver_results.py" "$@"; }
add() { results add judged/d.json --driver d --renderer llvmpipe --commit c --runs . --run d/lattice.paper.100x2; }
mkdir -p d judged
report='{"context": "llvmpipe", "verdict": "%s", "particles": 100, "frames": 2, "hits": 1, "hash": {"gpu": "0"}, "verdicts": {"particles": {"divergent": %s}, "texels": {"divergent": 0}}}'
for case in 'AGREE 0 0 0' 'LEGAL 0 0 0' 'UNDEFINED 0 1 1' 'DIVERGENT 7 1 1' 'AGREE 0 1 1'; do
    read -r verdict count status expected <<<"$case"
    # shellcheck disable=SC2059
    printf "$report" "$verdict" "$count" >d/lattice.paper.100x2.json
    echo "$status" >d/lattice.paper.100x2.status
    ends_with 0 add
    ends_with "$expected" results table judged --commit c --driver d
done
printf "$report" DIVERGENT 7 >d/lattice.paper.100x2.json
ends_with 0 add
ends_with 1 results table judged --commit c --driver d
says 'd lattice paper 100x2: DIVERGENT, 7 particle states and 0 texels divergent'
ends_with 0 results add judged/d.json --driver d --renderer softpipe --commit c --runs . --run d/lattice.paper.100x2
ends_with 2 results table judged --commit c --driver d
says 'd lattice paper 100x2: this is not softpipe: llvmpipe'

# Names.
ends_with 2 "${small[@]}" --only trixy-osmesa
says 'driver_matrix: no driver is named trixy-osmesa; there are bookworm-osmesa '
ends_with 2 "${small[@]}" --only here-egl --scene latice
says 'driver_matrix: no scene is named latice; there are bunny_a '
ends_with 2 "${small[@]}" --only here-egl --preset plain
says 'driver_matrix: no preset is named plain'
ends_with 2 "${small[@]}" --particle 3
says 'driver_matrix: --particle is not an option'
