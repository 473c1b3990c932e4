#!/usr/bin/env bash
# Installs what lockstep needs to run (Debian 12 or newer), builds it, and checks the bunny scene with 50,000 particles; then
# builds the other systems, and checks the small scenes, in which together every mistake with a name would show.
# Usage: scripts/demo.sh [OPTIONS of lockstep check]
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/crosscheck/lockstep
scripts/install_packages.sh --for demo
if [ ! -e "$program" ]; then # the collision system alone at first: its verdict comes in half the time
    cmake --preset release -DLOCKSTEP_SYSTEMS=
    cmake --build --preset release --target lockstep lockstep_decimate
fi
scripts/fetch_meshes.sh bunny
$program check data/scenes/bunny_a.json --particles 50000 "$@"
echo
echo "The first verdict came after $((SECONDS / 60)) min $((SECONDS % 60)) s. The other systems (dust, fluid, lifecycle, lights) are built now."
cmake --preset release -ULOCKSTEP_SYSTEMS >/dev/null
cmake --build --preset release
echo
$program check --stress
echo
echo "run it:      $program --help"
echo "install it:  cmake --install build/release --prefix ~/.local"
if [ ! -e build/report_page/report.html ]; then echo "report page: scripts/build_report_page.sh, once, for check --report"; fi
