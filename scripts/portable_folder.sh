#!/usr/bin/env bash
# Makes a folder that runs on any x86-64 Linux with a GPU driver, libEGL and libOpenGL (glvnd): the program, the
# libraries it needs apart from the C library, shaders, scenes, and the meshes if they were fetched. No Mesa, no package
# manager is needed there.
# Usage: scripts/portable_folder.sh DIR [BUILD]      BUILD: a build folder; otherwise build/release, which is made
# Then, there: DIR/bin/lockstep check DIR/share/lockstep/scenes/lattice.json --gl egl-device:0
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 1 ] || [ $# -eq 2 ] || { sed -n 5p "$0" | cut -c3- >&2; exit 2; }
folder=$1 build=${2:-build/release}

if [ "$build" = build/release ]; then cmake --preset release >/dev/null; fi
cmake --build "$build" --target lockstep lockstep_manual >/dev/null
rm -rf "$folder"
cmake --install "$build" --prefix "$folder" --component program --strip >/dev/null
mkdir -p "$folder/lib/runtime" "$folder/libexec"
ldd "$build/crosscheck/lockstep" | awk '$3 ~ /^\// { print $3 }' |
    grep -vE '/(libc|libm|libdl|libpthread|librt|ld-linux[^/]*)\.so' | xargs -I{} cp -L {} "$folder/lib/"

# The libraries that a GL driver needs too, perhaps newer ones: the machine's own serve wherever the program starts with
# them, which no older ones let it do.
mv "$folder"/lib/{libstdc++,libgcc_s,libz}.so.* "$folder/lib/runtime/"
mv "$folder/bin/lockstep" "$folder/libexec/"
cat >"$folder/bin/lockstep" <<'END'
#!/bin/sh
folder=$(dirname "$(dirname "$(readlink -f "$0")")")
# The loader takes an empty entry for the current folder.
LD_LIBRARY_PATH=$(printf %s "${LD_LIBRARY_PATH-}" | tr -s : | sed 's/^://; s/:$//')
if [ -n "$LD_LIBRARY_PATH" ]; then export LD_LIBRARY_PATH; else unset LD_LIBRARY_PATH; fi
"$folder/libexec/lockstep" --help >/dev/null 2>&1 ||
    export LD_LIBRARY_PATH="$folder/lib/runtime${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
exec "$folder/libexec/lockstep" "$@"
END
chmod +x "$folder/bin/lockstep"
if [ -d data/meshes ]; then cp -r data/meshes "$folder/share/lockstep/"; fi

# The libraries are the release's: Debian 13's HDF5 brings OpenSSL, Kerberos and LDAP along.
mib() { du -smc "$@" | tail -1 | cut -f1; }
own=$(mib "$folder/libexec" "$folder/share") whole=$(mib "$folder")
echo "$folder: $whole MiB, of which $own MiB are lockstep's"
[ "$own" -le 45 ] || { echo "portable_folder: program and data are over 45 MiB" >&2; exit 1; }
[ "$whole" -le 90 ] || { echo "portable_folder: $folder is over 90 MiB" >&2; exit 1; }
