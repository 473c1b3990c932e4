#!/usr/bin/env bash
# Installs what lockstep needs to run (Debian 12 or newer), builds it, and checks the bunny scene with 50,000 particles; then
# the small scenes, in which together every mistake with a name would show.
# Usage: scripts/demo.sh [OPTIONS of lockstep check]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh --for demo
cmake --preset release
cmake --build --preset release
scripts/fetch_meshes.sh bunny
build/release/crosscheck/lockstep check data/scenes/bunny_a.json --particles 50000 "$@"
echo
build/release/crosscheck/lockstep check --stress
echo
echo "run it:      build/release/crosscheck/lockstep --help"
echo "install it:  cmake --install build/release --prefix ~/.local"
if [ ! -e build/report_page/report.html ]; then echo "report page: scripts/build_report_page.sh, once, for check --report"; fi
