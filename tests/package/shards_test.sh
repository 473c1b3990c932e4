#!/usr/bin/env bash
# A check that CTest, Open MPI or a Slurm array shares comes to the report of one check (docs/shards.md).
# Usage: shards_test.sh SOURCE LOCKSTEP-PROGRAM
set -euo pipefail
source=$1 program=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
unset TEST_SHARD_INDEX TEST_TOTAL_SHARDS OMPI_COMM_WORLD_RANK OMPI_COMM_WORLD_SIZE

fail() { printf 'shards_test: %s\n' "$1" >&2; exit 1; }
lockstep() { "$program" "$@"; }
export PATH="$work/bin:$PATH"
mkdir bin
ln -s "$program" bin/lockstep

if ! lockstep record "$source/data/scenes/lattice.json" --particles 500 --frames 8 -o run.h5 >record.txt 2>&1; then
    [ "${LOCKSTEP_REQUIRE_GL:-}" != 1 ] || fail "$(cat record.txt)"
    echo "skipped: $(cat record.txt)"
    exit 77
fi
lockstep check --trace "$work/run.h5" --json whole.json >whole.txt
same() { cmp "$1" whole.json || fail "$2 comes to another report"; rm "$1"; }

# CTest
cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.20)
project(shared LANGUAGES NONE)
enable_testing()
include(${RULES})
lockstep_check_recording(run run.h5 SHARDS 3)
END
cmake -S . -B build -DRULES="$source/crosscheck/package/lockstepCheckRecording.cmake" >cmake.txt
ctest --test-dir build -j2 >ctest.txt || fail "$(cat ctest.txt)"
grep -qF '100% tests passed, 0 tests failed out of 5' ctest.txt || fail "$(cat ctest.txt)"
same build/run.parts/whole.json ctest
# Of an earlier run nothing is left: a part that does not run is missed.
ctest --test-dir build -E 'run\.2' >ctest.txt && fail "a missing part was not missed"
grep -qF 'run.merge (Failed)' ctest.txt || fail "$(cat ctest.txt)"

# What Slurm sets in a job array, --array=0-2
for id in 0 1 2; do
    SLURM_ARRAY_TASK_ID=$id SLURM_ARRAY_TASK_COUNT=3 bash -c \
        'lockstep check --trace run.h5 --shard $((SLURM_ARRAY_TASK_ID + 1))/$SLURM_ARRAY_TASK_COUNT --json slurm_$SLURM_ARRAY_TASK_ID.json' >/dev/null
done
lockstep check --trace run.h5 --json whole.json >whole.txt
lockstep merge slurm_*.json --json merged.json >merged.txt
same merged.json "a Slurm array"
cmp <(grep -v '^written ' merged.txt) <(grep -v '^written ' whole.txt)

# Open MPI
if command -v mpirun >/dev/null; then
    mpirun --allow-run-as-root --oversubscribe -n 2 \
        sh -c 'lockstep check --trace run.h5 --quiet --json mpi_$OMPI_COMM_WORLD_RANK.json' 2>mpi.txt || fail "$(cat mpi.txt)"
    lockstep merge mpi_*.json --json merged.json >merged.txt
    same merged.json "Open MPI"
else
    echo "without mpirun"
fi
