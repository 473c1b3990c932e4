#!/usr/bin/env bash
# A JUnit file of ctest keeps pass, fail and skipped apart, and scripts/junit_properties.sh writes renderer and profile
# into it.
# Usage: junit_properties_test.sh SOURCE LOCKSTEP-PROGRAM
set -euo pipefail
script=$1/scripts/junit_properties.sh program=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { printf 'junit_properties_test: %s\n' "$1" >&2; [ ! -f junit.xml ] || cat junit.xml >&2; exit 1; }
says() { grep -qF -- "$1" "${2:-junit.xml}" || fail "this is not said: $1"; }

cat >CTestTestfile.cmake <<'END'
add_test(passes true)
add_test(fails false)
add_test(skipped sh -c "echo 'skipped: no <GL>'; exit 77")
set_tests_properties(skipped PROPERTIES SKIP_RETURN_CODE 77)
END
ctest --output-junit junit.xml >/dev/null 2>&1 && fail "a failed test did not make ctest fail"
"$script" junit.xml "$program" --gl egl-device:99
says 'failures="1"'
says 'skipped="1"'
says '<property name="renderer" value="none: lockstep: no GL context: egl-device:99: '
says '<property name="profile" value="none"/>'
! command -v python3 >/dev/null || python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' junit.xml

ctest --output-junit junit.xml >/dev/null 2>&1 || true
if "$program" probe >probed.txt 2>&1; then
    "$script" junit.xml "$program"
    says "<property name=\"renderer\" value=\"$(head -n 1 probed.txt)\"/>"
    says '<property name="profile" value="'
elif [ "${LOCKSTEP_REQUIRE_GL:-}" = 1 ]; then
    fail "$(cat probed.txt)"
fi

echo 'no XML' >other.xml
"$script" other.xml "$program" 2>error.txt && fail "a file that is not JUnit was taken"
says 'other.xml: no <testsuite> in it' error.txt
