#!/usr/bin/env bash
# Installs what the tests need (Debian 12 or newer), builds with warnings as errors, and runs every test. A missing GL is
# a failure here, not a skip; so are a missing mesh, and a missing OSMesa where the release has one. build/ci/junit.xml tells each test's
# result, and renderer and profile.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh
scripts/build_report_page.sh
scripts/build_graph_page.sh
cmake --preset ci
cmake --build --preset ci
scripts/fetch_meshes.sh
status=0
if apt-cache show libosmesa6 >/dev/null 2>&1; then export LOCKSTEP_REQUIRE_OSMESA=1; fi
LOCKSTEP_REQUIRE_GL=1 LOCKSTEP_REQUIRE_MESHES=1 ctest --test-dir build/ci --no-tests=error --output-on-failure --output-junit junit.xml -j "$(($(nproc) + 1))" "$@" || status=$?
scripts/junit_properties.sh build/ci/junit.xml build/ci/crosscheck/lockstep
exit "$status"
