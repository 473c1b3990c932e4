#!/usr/bin/env bash
# Installs what lockstep needs (Debian 12 or newer), builds it, and checks the bunny scene with 50,000 particles.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
scripts/build_report_page.sh || echo "demo: no report page, which only check --report and report need" >&2
cmake --preset release
cmake --build --preset release --target lockstep lockstep_decimate lockstep_api
scripts/fetch_meshes.sh bunny
build/release/crosscheck/lockstep check data/scenes/bunny_a.json --particles 50000 "$@"
echo
echo "run it:     build/release/crosscheck/lockstep --help"
echo "install it: cmake --install build/release --prefix ~/.local"
