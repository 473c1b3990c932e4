#!/usr/bin/env bash
# Makes a folder that runs on any x86-64 Linux with a GPU driver, libEGL and libOpenGL (glvnd): the program, the
# libraries it needs apart from the C library, shaders, scenes, and the meshes if they were fetched. No Mesa, no package
# manager is needed there.
# Usage: scripts/portable_folder.sh DIR        then, there: DIR/bin/lockstep check DIR/share/lockstep/scenes/lattice.json --gl egl-device:0
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 1 ] || { sed -n 5p "$0" | cut -c3- >&2; exit 2; }
folder=$1

cmake --preset release >/dev/null
cmake --build --preset release --target lockstep >/dev/null
rm -rf "$folder"
cmake --install build/release --prefix "$folder" --component program --strip >/dev/null
mkdir -p "$folder/lib"
ldd build/release/crosscheck/lockstep | awk '$3 ~ /^\// { print $3 }' |
    grep -vE '/(libc|libm|libdl|libpthread|librt|ld-linux[^/]*)\.so' | xargs -I{} cp -L {} "$folder/lib/"
if [ -d data/meshes ]; then cp -r data/meshes "$folder/share/lockstep/"; fi

kib=$(du -sk "$folder" | cut -f1)
echo "$folder: $((kib / 1024)) MiB"
[ "$kib" -le $((60 * 1024)) ] || { echo "portable_folder: $folder is over 60 MiB" >&2; exit 1; }
