#!/usr/bin/env bash
# Runs the tests of the report page. Status 77: skipped; with LOCKSTEP_REQUIRE_GL=1 that is a failure.
# Usage: tests/page/run.sh LOCKSTEP-PROGRAM
set -euo pipefail
cd "$(dirname "$0")/../.."

skip() {
    echo "skipped: $*"
    [ "${LOCKSTEP_REQUIRE_GL:-}" = 1 ] && exit 1
    exit 77
}

command -v node >/dev/null || skip "no node"
command -v chromium >/dev/null || skip "no chromium"
[ -f build/report_page/report.html ] && [ -d crosscheck/report_page/node_modules/playwright-core ] ||
    skip "the page is not built; run scripts/build_report_page.sh"
LOCKSTEP_PROGRAM=$(realpath "$1") exec node --test --test-reporter=spec tests/page/*.test.mjs
