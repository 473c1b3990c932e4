#!/usr/bin/env bash
# Builds the editor of node graphs, build/graph_page/graph.html: one file, from crosscheck/graph_page and the npm packages
# its lock file names. Installs Node.js and npm; lockstep itself needs neither.
# Usage: scripts/build_graph_page.sh
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh --for page
cd crosscheck/graph_page
# Node trusts only its own certificates; a machine behind a proxy has more in the system's store.
export NODE_EXTRA_CA_CERTS=${NODE_EXTRA_CA_CERTS:-/etc/ssl/certs/ca-certificates.crt}
if [ ! node_modules/.package-lock.json -nt package-lock.json ]; then npm ci --ignore-scripts --loglevel=error; fi
node build.mjs ../../build/graph_page/graph.html
