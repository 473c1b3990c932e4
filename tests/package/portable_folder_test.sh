#!/usr/bin/env bash
# A folder made by scripts/portable_folder.sh: its program runs from anywhere with the machine's own C++ runtime and zlib,
# and with those brought along where the machine's are too old.
# Usage: portable_folder_test.sh SOURCE BUILD
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { printf 'portable_folder_test: %s\n' "$1" >&2; cat "$work/out.txt" >&2; exit 1; }
"$1/scripts/portable_folder.sh" "$work/made" "$2" >"$work/out.txt" 2>&1 || fail "status $?"
mkdir "$work/a folder"
mv "$work/made" "$work/a folder/moved"
folder="$work/a folder/moved"
ln -s "$folder/bin/lockstep" "$work/lockstep"
cd /
"$work/lockstep" hash "$folder/share/lockstep/scenes/lattice.json" --particles 100 --frames 2 >"$work/out.txt" 2>&1 || fail "status $?"
LD_TRACE_LOADED_OBJECTS=1 "$folder/libexec/lockstep" >"$work/out.txt"
grep -F "$folder" "$work/out.txt" >"$work/own.txt"
grep -q 'libassimp' "$work/own.txt" || fail "it has another assimp than its own"
for library in libstdc++ libgcc_s libz; do
    compgen -G "$folder/lib/runtime/*$library.so*" > /dev/null || fail "$library is not brought along"
    ! grep -qF "$library.so" "$work/own.txt" || fail "$library is its own, not the machine's"
done

# Nothing of the current folder is loaded, whatever empty entries the search path has.
. "$1/tests/package/library_folders.sh"
[ -z "$(unfit_library_folders "$folder")" ] || fail "it looks for libraries in $(unfit_library_folders "$folder")"
mkdir "$work/planted"
plant_libraries "$folder/libexec/lockstep" "$work/planted"
ldd /bin/sh | awk '$2 == "=>" { print $1 }' | (cd "$work/planted" && xargs rm -f) # bin/lockstep is a script: with such entries /bin/sh itself loads these
cd "$work/planted"
for entries in : :: /nowhere: ::/nowhere; do
    LD_LIBRARY_PATH=$entries "$work/lockstep" --version >"$work/out.txt" 2>&1 || fail "a library of the current folder is loaded with LD_LIBRARY_PATH=$entries"
done
cd /

# A program that starts with the libraries brought along alone.
cat >"$folder/libexec/lockstep" <<'END'
#!/bin/sh
case ${LD_LIBRARY_PATH:-} in */lib/runtime*) echo "brought along: $*" ;; *) exit 127 ;; esac
END
"$work/lockstep" check 'a b' >"$work/out.txt" 2>&1 || fail "status $? with an old runtime"
grep -qx 'brought along: check a b' "$work/out.txt" || fail "with an old runtime it says something else"
