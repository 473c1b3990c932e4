#!/usr/bin/env bash
# Runs the tests of a page, `report` or `graph`. Status 77: skipped; with LOCKSTEP_REQUIRE_GL=1 that is a failure.
# Usage: tests/page/run.sh LOCKSTEP-PROGRAM [PAGE]
set -euo pipefail
cd "$(dirname "$0")/../.."

skip() {
    echo "skipped: $*"
    [ "${LOCKSTEP_REQUIRE_GL:-}" = 1 ] && exit 1
    exit 77
}

page=${2:-report}
case $page in
report) tests=(report live shader_source state_hash) ;;
graph) tests=(graph) ;;
*) echo "tests/page/run.sh: '$page' is no page; right is report or graph" >&2 && exit 2 ;;
esac
command -v node >/dev/null || skip "no node"
command -v chromium >/dev/null || skip "no chromium"
[ -d crosscheck/report_page/node_modules/playwright-core ] ||
    skip "there is no Playwright; run scripts/build_report_page.sh"
[ -f "build/${page}_page/$page.html" ] || skip "the page is not built; run scripts/build_${page}_page.sh"
LOCKSTEP_PROGRAM=$(realpath "$1") exec node --test --test-reporter=spec $(printf "tests/page/%s.test.mjs " "${tests[@]}")
