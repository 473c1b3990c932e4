#!/usr/bin/env bash
# Installs the Debian 12 packages that building, testing and running lockstep needs. Does nothing where all are there.
# Usage: scripts/install_packages.sh
set -euo pipefail

packages=(
    g++ cmake ninja-build                         # build; g++ brings OpenMP
    libglm-dev libfmt-dev libcli11-dev            # vectors, text, command line
    nlohmann-json3-dev libpng-dev                 # scenes and reports, pictures
    zlib1g-dev                                    # the report page's data, traces
    libassimp-dev libmeshoptimizer-dev            # meshes: reading, decimation
    libhdf5-dev libaec-dev                        # traces: H5MD
    libdeflate-dev nettle-dev                     # reading them fast, their seal
    libseccomp-dev                                # the fence around the process that reads one
    python3-numpy python3-h5py                    # the example that writes one
    libgl-dev libegl-dev                          # GL headers; the libraries are opened at run time
    libosmesa6 libegl1 libgl1-mesa-dri            # contexts without a GPU
    catch2 libnanoflann-dev                       # tests and their oracle for neighbours
    libbenchmark-dev                              # benchmarks
    gnuplot-nox                                   # charts of lockstep study
)

# Where Node.js did not come from Debian, npm came with it.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)
packages+=(chromium)                              # the report page is built by npm and tested in Chromium
packages+=(python3-h5py)                          # states that the page saved become a trace

missing=()
for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { echo "install_packages: run as root, or install sudo; missing: ${missing[*]}" >&2; exit 2; }
    as_root=(sudo)
fi
echo "installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
