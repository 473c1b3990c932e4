#!/usr/bin/env bash
# Programs and libraries of the build tree and of an installed tree are loaded from fixed folders, never from the folder
# they are run in; also where a surrounding project or a packager sets CMAKE_INSTALL_RPATH.
# Usage: library_folders_test.sh SOURCE BUILD COMPILER
set -euo pipefail
source=$1 build=$2 compiler=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { printf 'library_folders_test: %s\n' "$1" >&2; exit 1; }
. "$source/tests/package/library_folders.sh"

# What the check itself finds.
echo 'int main() { return 0; }' >"$work/main.cpp"
for path in : /nowhere: relative '$ORIGIN/../lib:'; do
    "$compiler" -o "$work/found" "$work/main.cpp" "-Wl,-rpath,$path"
    [ -n "$(unfit_library_folders "$work")" ] || fail "the check does not find the path '$path'"
done
"$compiler" -o "$work/found" "$work/main.cpp" '-Wl,-rpath,$ORIGIN/../lib:/usr/lib'
[ -z "$(unfit_library_folders "$work")" ] || fail "the check refuses fixed folders"

cmake --install "$build" --prefix "$work/installed" --component program >/dev/null
unfit=$(unfit_library_folders "$build" "$work/installed")
[ -z "$unfit" ] || fail "looked for in the current folder: $unfit"

for program in "$build/crosscheck/lockstep" "$work/installed/bin/lockstep"; do
    mkdir -p "$work/planted"
    plant_libraries "$program" "$work/planted"
    [ -e "$work/planted/libpng16.so.16" ] || fail "$program loads no libpng"
    (cd "$work/planted" && "$program" --version >/dev/null) || fail "$program loads a library of the current folder"
done

cmake -S "$source" -B "$work/outer" -G "Unix Makefiles" "-DCMAKE_CXX_COMPILER=$compiler" -DLOCKSTEP_BUILD_TESTS=OFF \
    '-DCMAKE_INSTALL_RPATH=$ORIGIN/../lib' >/dev/null
! grep -rE --include=link.txt 'rpath,[^ ]*(::|:\\?"? )' "$work/outer" || fail "CMAKE_INSTALL_RPATH leaves empty entries"
