#!/usr/bin/env bash
# Installs lockstep, moves the installation, and builds and runs tests/consumer against it: its shader passes, the broken
# one fails with the program's report and a line that repeats it, and without GL its tests are skipped.
# Usage: consumer_test.sh SOURCE BUILD [CMAKE_OPTION...]     exit status 77: no GL here
set -euo pipefail
source=$1 build=$2
shift 2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { printf 'consumer_test: %s\n' "$1" >&2; cat out.txt >&2; exit 1; }
succeeds() { "$@" >out.txt 2>&1 || fail "status $?: $*"; }
ends_with() {
    local expected=$1 status=0
    shift
    "$@" >out.txt 2>&1 || status=$?
    [ "$status" = "$expected" ] || fail "status $status, not $expected: $*"
}
# Commands of docs/own_system.md, which are run as they stand there.
page_lines() { grep "^    $1 " "$source/docs/own_system.md" | sed 's/^ *//'; }
# Wherever its lines are broken.
says() { tr -s '\\\n ' ' ' <out.txt | grep -F -- "$1" > /dev/null || fail "this is not said: $1"; }

succeeds cmake --install "$build" --prefix "$work/built"
mv built prefix
succeeds cmake -S "$source/tests/consumer" -B build "-DCMAKE_PREFIX_PATH=$work/prefix" "$@"
succeeds cmake --build build

# Without GL.
succeeds env -u LOCKSTEP_REQUIRE_GL LOCKSTEP_GL=egl-device:99 ctest --test-dir build -V
says 'skipped: no GL context: egl-device:99: '
if [ -x build/gtest_tests ]; then says 'gtest.Shaders.AWallKeepsHalf'; fi
says '(Skipped)'
ends_with 8 env LOCKSTEP_REQUIRE_GL=1 LOCKSTEP_GL=egl-device:99 ctest --test-dir build -V
says 'LOCKSTEP_REQUIRE_GL is set, but no GL context: egl-device:99: '

# With it.
succeeds ctest --test-dir build -V
if grep -qF '(Skipped)' out.txt; then exit 77; fi
ends_with 1 build/shader_tests '[.broken]'
says 'CHECK_THAT( gpu, MatchesReference(scene).frames(60) )'
says "scene x_streams ($work/prefix/share/lockstep/scenes/x_streams.json --particles 10000)"
says 'verdict DIVERGENT from frame '
says 'cause all 12 particles are explained by last_found_instead_of_nearest'
says "again: lockstep explain $work/prefix/share/lockstep/scenes/x_streams.json --particles 10000 --frame "
says "repeat lockstep check $work/prefix/share/lockstep/scenes/x_streams.json --particles 10000 --frames "
sed -n '/^  repeat    /,/[^\\]$/p' out.txt | sed 's/repeat    //' >repeat.sh
PATH="$work/prefix/bin:$PATH" ends_with 1 bash repeat.sh
says 'verdict DIVERGENT from frame '

# Other frameworks show the same: verdict, cause, first difference and the command that repeats it come first.
for framework in gtest doctest; do
    [ -x build/${framework}_tests ] || continue
    case $framework in
    gtest) broken=(--gtest_also_run_disabled_tests '--gtest_filter=*DISABLED*' --gtest_output=xml:junit.xml) ;;
    doctest) broken=(--no-skip '--test-case=*the last') ;;
    esac
    ends_with 1 build/${framework}_tests "${broken[@]}"
    says 'DIVERGENT from frame '
    grep -n 'verdict  \|cause  \|first  \|repeat  \|scene  ' out.txt | sed 's/.*\(verdict\|cause\|first\|repeat\|scene\)  .*/\1/' | tr '\n' ' ' >order
    grep -q 'verdict cause first repeat scene' order || fail "$framework shows another order: $(cat order)"
    ! grep -q 'nobody comes by here' out.txt || fail "$framework: LOCKSTEP_REQUIRE goes on"
    [ $framework = gtest ] || build/doctest_tests "${broken[@]}" --reporters=junit >junit.xml || true
    grep -q '<failure message="[^"]*DIVERGENT from frame ' junit.xml || fail "the JUnit message of $framework is no verdict"
done

# A system of its own, with every verb on a planted mistake.
succeeds build/grains check --frames 30
says 'verdict '
mkdir planted
sed 's/u_Gravity - a_Velocity \* u_Drag/u_Gravity/' "$source/tests/consumer/grains/grains_step.vert" >planted/grains_step.vert
ends_with 1 build/grains check --frames 30 --shaders planted --json report.json --capsule capsule.json
says 'verdict DIVERGENT from frame 0 on'
says 'explained by '
says 'u_Drag: zero'
says 'first frame 0 grain 0, divergent, step grains_step'
says 'grains explain --frame 0 --pass grains_step --item 0'
grep -q '"verdict": "DIVERGENT"' report.json || fail 'the JSON report does not say DIVERGENT'
succeeds build/grains explain --frame 3 --item 17 --shaders planted
says 'first acceleration.'
printf 'next divergence\nitem 17\nhistory\nwhy\n' >walk
ends_with 0 build/grains debug --shaders planted <walk
says 'frame 0 grains_step, grain 17'
says 'verdict divergent'
printf 'set tick=1\n' >walk
ends_with 2 build/grains debug <walk
says "line 1: set: this program's system has no switches"
ends_with 1 build/grains capsule show capsule.json
says 'first acceleration.'
succeeds build/grains capsule cut --frame 3 --item 17 --shaders planted -o 17.json
ends_with 1 build/grains capsule show 17.json --hex
says 'grain 17 in frame 3, pass grains_step'
ends_with 2 build/grains check --trace capsule.json
says 'capsule.json: not a trace'
succeeds build/grains record --frames 10 --shaders planted -o run.h5
says '2,000 grains, 10 frames'
ends_with 1 build/grains check --trace run.h5 --hashes hashes
says 'verdict DIVERGENT from frame 0 on'
says 'u_Drag: zero'
says 'grains explain --frame 0 --pass grains_step --item 0 --trace run.h5'
[ "$(wc -l <hashes)" = 10 ] || fail 'a hash for each frame'
succeeds build/grains explain --trace run.h5 --frame 3 --item 17
says 'grain 17 in frame 3, pass grains_step'
succeeds build/grains trace run.h5
says 'every value read'
ends_with 2 build/grains check --trace run.h5 --frames 11
says '--frames 11: run.h5 holds 10 frames'
if [ -f prefix/share/lockstep/report.html ]; then
    ends_with 1 build/grains report run.h5 -o pages --quiet
    grep -q '"verdict":"DIVERGENT"' pages/report.html || fail 'the page does not say DIVERGENT'
    ends_with 1 build/grains capsule show pages/capsule.json
fi
mkdir page
cp capsule.json page
while read -r verb; do
    status=0
    (cd page && PATH="$work/build:$PATH" bash -ec "$verb") >out.txt 2>&1 || status=$?
    [ "$status" -lt 2 ] || [[ $verb = *report* && ! -f prefix/share/lockstep/report.html ]] || fail "status $status: $verb"
done < <(page_lines grains)
[ -f page/run.h5 ] && [ -f page/17.json ] || fail 'the page writes no recording or capsule'
succeeds build/grains hash --frames 5
says '4 '
ends_with 2 build/grains check --frame 30
says "unknown option '--frame'; did you mean --frames?"
ends_with 2 build/grains bench
says "unknown verb 'bench'; the verbs are check, explain, debug, capsule, hash, record, trace, report"
ends_with 2 build/grains explain --frame 3 --item 2000
says "there is no grain '2000'; grains has 0 to 1999"

# A system that lockstep began: DIVERGENT until its twin is written, then not, and a planted bug has its name.
# A name that is a function of C's, too.
begin=$(page_lines 'lockstep new system' | sed 's/sparks/signal/g')
build_and_check=$(page_lines 'cmake -S sparks' | sed 's/sparks/signal/g')
[ -n "$begin" ] && [ -n "$build_and_check" ] || fail 'docs/own_system.md does not begin a system'
export CMAKE_PREFIX_PATH=$work/prefix
succeeds env PATH="$work/prefix/bin:$PATH" bash -ec "$begin"
says 'signal: a system with one pass'
ends_with 2 prefix/bin/lockstep new system signal
says 'signal exists and is not empty'
ends_with 2 prefix/bin/lockstep new system 'Two words'
says "'Two words' cannot be its name"
ends_with 1 bash -ec "${build_and_check/signal\/build/signal/build $(printf ' %q' "$@")}"
says 'verdict DIVERGENT from frame 0 on'
ends_with 8 ctest --test-dir signal/build
sed -i -e '/TO BE WRITTEN/d' -e 's|^        //     |        |' signal/signal.hpp
succeeds cmake --build signal/build
succeeds signal/build/signal check --frames 30
says 'verdict AGREE'
succeeds ctest --test-dir signal/build
sed -i 's/a_Velocity + u_Gravity \* u_Tick/a_Velocity/' signal/signal_step.vert
ends_with 1 signal/build/signal check --frames 5
says 'explained by gravity_missing'

# No program of these projects looks for libraries in the current folder.
. "$source/tests/package/library_folders.sh"
unfit_library_folders build signal >out.txt
[ ! -s out.txt ] || fail "these look for libraries in the current folder"

# The shaders are the package's.
echo 'not GLSL' >>prefix/share/lockstep/shaders/collision/collision_pass.frag
ends_with 8 ctest --test-dir build -V
says 'shader shaders/collision/collision_pass.frag:'
