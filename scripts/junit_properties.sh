#!/usr/bin/env bash
# Writes renderer and driver profile into a JUnit file of ctest (--output-junit), as properties of the whole run.
# Usage: scripts/junit_properties.sh FILE LOCKSTEP-PROGRAM [probe's options, --gl osmesa]
set -euo pipefail
[ $# -ge 2 ] || { sed -n 3p "$0" | cut -c3- >&2; exit 2; }
file=$1 program=$2
shift 2
grep -q '^<testsuite' "$file" || { echo "junit_properties: $file: no <testsuite> in it; ctest --output-junit writes one" >&2; exit 2; }

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g; s/"/\&quot;/g'; }
if probed=$("$program" probe "$@" 2>&1); then
    renderer=$(head -n 1 <<<"$probed" | escaped)
    profile=$(sed -n 's/^profile //p' <<<"$probed" | escaped)
else
    renderer="none: $(escaped <<<"$probed")"
    profile=none
fi
RENDERER=$renderer PROFILE=$profile awk '
    !done && (/<testcase/ || /<\/testsuite>/) {
        print "\t<properties>"
        print "\t\t<property name=\"renderer\" value=\"" ENVIRON["RENDERER"] "\"/>"
        print "\t\t<property name=\"profile\" value=\"" ENVIRON["PROFILE"] "\"/>"
        print "\t</properties>"
        done = 1
    }
    { print }' "$file" >"$file.new"
mv "$file.new" "$file"
