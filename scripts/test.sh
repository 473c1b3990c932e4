#!/usr/bin/env bash
# Installs what the tests need (Debian 12), builds with warnings as errors, and runs every test. A missing GL is a
# failure here, not a skip.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
scripts/build_report_page.sh
cmake --preset ci
cmake --build --preset ci
scripts/fetch_meshes.sh bunny
LOCKSTEP_REQUIRE_GL=1 ctest --test-dir build/ci --output-on-failure -j 2 "$@"
