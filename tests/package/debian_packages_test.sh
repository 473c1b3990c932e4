#!/usr/bin/env bash
# The packages that cpack makes of a finished build: they unpack into a tree that runs, and name what they need.
# Usage: debian_packages_test.sh SOURCE BUILD
set -euo pipefail
build=$2
for tool in dpkg-deb dpkg-shlibdeps file; do
    command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "debian packages: $*" >&2; exit 1; }

(cd "$build" && cpack -G DEB -B "$folder/made" >"$folder/log" 2>&1) || { cat "$folder/log" >&2; fail "cpack failed"; }
program=$(echo "$folder"/made/lockstep_*.deb) library=$(echo "$folder"/made/liblockstep-dev_*.deb)
for package in "$program" "$library"; do
    dpkg-deb -x "$package" "$folder/root" || fail "$package does not unpack"
    if command -v lintian >/dev/null; then
        lintian --allow-root "$package" >"$folder/lintian" 2>&1 || true
        grep -q '^[EW]: ' "$folder/lintian" && { cat "$folder/lintian" >&2; fail "lintian has findings"; }
    fi
done
dpkg-deb -f "$program" Depends | grep 'libegl1.*libc6' > /dev/null || fail "the program does not name the libraries that it needs"
dpkg-deb -f "$library" Depends | grep 'lockstep (= .*libhdf5-dev' > /dev/null || fail "the library does not name its parts"

. "$1/tests/package/library_folders.sh"
[ -z "$(unfit_library_folders "$folder/root")" ] || fail "unpacked programs look for libraries in $(unfit_library_folders "$folder/root")"
root=$folder/root/usr
[ "$("$root/bin/lockstep" --version)" = "lockstep $(dpkg-deb -f "$program" Version)" ] || fail "another version runs"
"$root/bin/lockstep" hash "$root/share/lockstep/scenes/lattice.json" --particles 100 --frames 2 >/dev/null ||
    fail "the unpacked program does not find its files"
for file in lib/cmake/lockstep/lockstepConfig.cmake include/lockstep/lockstep.hpp lib/liblockstep_api.a \
    share/doc/lockstep/copyright share/man/man1/lockstep.1.gz; do
    [ -s "$root/$file" ] || fail "$file is missing"
done
