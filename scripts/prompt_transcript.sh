#!/usr/bin/env bash
# A session of `lockstep debug` on a terminal of tmux, keys and all: Tab completes, Up brings back what was typed, Ctrl-C
# stops a run and not the session. Writes what the terminal showed after each of them.
# Usage: scripts/prompt_transcript.sh PROGRAM >data/results/prompt.txt      needs tmux
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "$1")
work=$(mktemp -d)
run() { tmux -S "$work/socket" "$@"; }
trap 'run kill-server 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/mine"
ln -s "$program" "$work/bin/lockstep"
sed 's/ && len < particle_min_length//' shaders/collision/collision_pass.vert >"$work/mine/collision_pass.vert"
ln -s "$PWD/data" "$work/data"

# say KEYS: what is on the terminal since the last time, from the line on that was the last one then.
seen=0
say() {
    local all
    all=$(run capture-pane -p -S - | sed -e 's/[[:space:]]*$//' -e "s|$work|~|g")
    printf '\n=== %s\n%s\n' "$1" "$(tail -n +"$((seen > 0 ? seen : 1))" <<<"$all")"
    seen=$(wc -l <<<"$all")
}
# shown TEXT: waits until the terminal shows it, half a minute at most.
shown() {
    for _ in $(seq 300); do
        if run capture-pane -p -S - | grep -qF -- "$1"; then return; fi
        sleep 0.1
    done
    echo "prompt_transcript: '$1' was not shown" >&2
    run capture-pane -p >&2
    exit 1
}
keys() { run send-keys "$@"; }

run -f /dev/null new-session -d -x 110 -y 60 "cd '$work'; PATH='$work/bin:$PATH' HOME='$work' PS1='$ ' exec bash --norc"
shown '$'
keys 'lockstep debug data/scenes/x_streams.json --gl osmesa --shaders mine --frames 100000' Enter
shown '(lockstep)'
say 'lockstep debug data/scenes/x_streams.json --gl osmesa --shaders mine --frames 100000'
keys 'ne' Tab 'div' Tab
shown 'next divergence'
say 'n e Tab d i v Tab'
keys Enter
sleep 5
say 'Enter'
keys 'why' Enter
sleep 1
say 'w h y Enter'
keys Up Up
shown 'next divergence'
say 'Up Up'
keys C-u 'break speed < 0.00001' Enter 'continue' Enter
sleep 3
keys C-c
sleep 3
say 'Ctrl-U, break speed < 0.00001, continue, and Ctrl-C after three seconds'
keys 'print speed' Enter
sleep 1
say 'the session goes on: print speed'
keys 'quit' Enter
shown '$'
say 'quit'
