#!/usr/bin/env bash
# Does what docs/unit_tests.md says, word by word, with an installation made here: its files are written, its commands are
# run in a home of their own, and the test fails and passes where the page says so.
# Usage: unit_tests_page_test.sh SOURCE BUILD [CMAKE_OPTION...]     exit status 77: no GL here
set -euo pipefail
page=$1/docs/unit_tests.md build=$2
shift 2

export HOME
HOME=$(mktemp -d)
trap 'rm -rf "$HOME"' EXIT
cd "$HOME"

fail() { printf 'unit_tests_page_test: %s\n' "$1" >&2; cat "$HOME/out.txt" >&2; exit 1; }

# The blocks of one kind, as the page's fence names it: `sh`, `sh fails`, `cpp`, ...
block() { awk -v fence="\`\`\`$1" '/^```/ { inside = ($0 == fence); next } inside' "$page"; }
# The n-th `sh` block.
shell_block() { awk -v n="$1" '/^```/ { inside = ($0 == "```sh"); found += inside; next } inside && found == n' "$page"; }
run() { bash -e -c "$1" >"$HOME/out.txt" 2>&1; }
says() { grep -qF -- "$1" "$HOME/out.txt"; }

[[ $(block 'sh install') == *'--install build/release --prefix ~/.local'* ]] || fail "the page installs elsewhere"
run "cmake --install '$build' --prefix ~/.local" || fail "lockstep cannot be installed"
run "$(shell_block 1)" || fail "the first commands failed"
cd engine_tests
block cmake >CMakeLists.txt
block cpp >shader_test.cpp

status=0
run "$(block 'sh fails' | sed "s|^cmake -B build|& $(printf ' %q' "$@")|")" || status=$?
if says '(Skipped)'; then exit 77; fi
[ "$status" != 0 ] || fail "the broken shader passed"
says 'last_found_instead_of_nearest' || fail "the page shows another failure"
run "$(shell_block 2)" || fail "the shader put right failed"
says '100% tests passed' || fail "the shader put right was not tested"

block 'cpp without_catch.cpp' >without_catch.cpp
cat >>CMakeLists.txt <<'END'
add_executable(without_catch without_catch.cpp)
target_link_libraries(without_catch PRIVATE lockstep::lockstep)
END
run 'cmake --build build && build/without_catch' || fail "the page's program without Catch2 failed"
says 'verdict   AGREE: every bit of 1,000 particles' || fail "the page's program without Catch2 says something else"
